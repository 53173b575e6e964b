#include "radiosity/answers/charts/rectangle_packing.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// The outline of what is placed: steps from left to right.
class Skyline {
  public:
    explicit Skyline(int side) : side_(side), steps_{{0, 0, side}} {}

    struct Place {
        std::size_t step;
        int top;    ///< the row behind the rectangle
        long waste; ///< area below it that is lost
    };
    /// Returns the best place of a rectangle, if there is any.
    [[nodiscard]] std::optional<Place> find(int width, int height) const {
        std::optional<Place> best;
        for (std::size_t k = 0; k < steps_.size(); ++k)
            if (const auto place = at(k, width, height);
                place &&
                (!best || std::pair(place->top, place->waste) < std::pair(best->top, best->waste)))
                best = place;
        return best;
    }
    /// Places a rectangle there; returns its column.
    int put(const Place& place, int width) {
        const int column = steps_[place.step].column, end = column + width;
        const auto first = steps_.begin() + static_cast<std::ptrdiff_t>(place.step);
        auto last = first;
        while (last != steps_.end() && last->column + last->width <= end)
            ++last;
        if (last != steps_.end() && last->column < end) {
            last->width -= end - last->column;
            last->column = end;
        }
        const auto here = steps_.erase(first, last);
        steps_.insert(here, {column, place.top, width});
        join();
        return column;
    }

  private:
    struct Step {
        int column, row, width;
    };
    [[nodiscard]] std::optional<Place> at(std::size_t step, int width, int height) const {
        const int column = steps_[step].column;
        if (column + width > side_)
            return std::nullopt;
        int row = 0;
        long area = 0;
        for (std::size_t k = step; k < steps_.size() && steps_[k].column < column + width; ++k) {
            row = std::max(row, steps_[k].row);
            area +=
                long{steps_[k].row} *
                (std::min(steps_[k].column + steps_[k].width, column + width) - steps_[k].column);
        }
        if (row + height > side_)
            return std::nullopt;
        return Place{step, row + height, long{row} * width - area};
    }
    void join() {
        for (std::size_t k = 1; k < steps_.size();)
            if (steps_[k].row == steps_[k - 1].row) {
                steps_[k - 1].width += steps_[k].width;
                steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(k));
            } else {
                ++k;
            }
    }

    int side_;
    std::vector<Step> steps_;
};

} // namespace

bool pack_rectangles(std::span<PackedRectangle> rectangles, int side) {
    std::vector<std::size_t> order(rectangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto sides = [&](std::size_t k) {
        return std::minmax({rectangles[k].width, rectangles[k].height});
    };
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        const auto [short_a, long_a] = sides(a);
        const auto [short_b, long_b] = sides(b);
        return std::pair(long_a, short_a) > std::pair(long_b, short_b);
    });
    Skyline skyline(side);
    for (const std::size_t k : order) {
        PackedRectangle& rectangle = rectangles[k];
        auto place = skyline.find(rectangle.width, rectangle.height);
        const auto turned = skyline.find(rectangle.height, rectangle.width);
        rectangle.turned = turned && (!place || std::pair(turned->top, turned->waste) <
                                                    std::pair(place->top, place->waste));
        if (rectangle.turned)
            place = turned;
        if (!place)
            return false;
        const int width = rectangle.turned ? rectangle.height : rectangle.width;
        const int height = rectangle.turned ? rectangle.width : rectangle.height;
        rectangle.row = place->top - height;
        rectangle.column = skyline.put(*place, width);
    }
    return true;
}

} // namespace hemilux
