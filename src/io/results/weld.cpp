#include "io/results/weld.h"

#include "bvh/tracer.h"
#include "radiosity/sampling/rng.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Cells much wider than the distance: few points lie so near a border that several must be
/// visited.
constexpr double cell_widths = 64;

std::uint64_t cell_of(const Vec3& point, double width) {
    const auto index = [&](double x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / width)));
    };
    return hash_words({index(point.x), index(point.y), index(point.z)});
}

} // namespace

std::uint32_t Welder::add(const Vec3& point) {
    const double width = cell_widths * distance_;
    const std::uint64_t home = cell_of(point, width);
    std::uint64_t last = ~home;
    for (int i = 0; i < 8; ++i) {
        const Vec3 side(i & 1 ? distance_ : -distance_, i & 2 ? distance_ : -distance_,
                        i & 4 ? distance_ : -distance_);
        const std::uint64_t cell = cell_of(point + side, width);
        if (cell == last)
            continue;
        last = cell;
        if (const std::uint32_t found = find(point, cell); found != none)
            return found;
    }
    append(point, home);
    return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t Welder::find(const Vec3& point, std::uint64_t cell) const {
    if (first_.empty())
        return none;
    std::uint32_t number = first_[cell & (first_.size() - 1)];
    while (number != none &&
           !(home_[number] == cell && glm::distance(points_[number], point) <= distance_))
        number = next_[number];
    return number;
}

void Welder::append(const Vec3& point, std::uint64_t home) {
    if (points_.size() == first_.size())
        grow();
    points_.push_back(point);
    home_.push_back(home);
    std::uint32_t& first = first_[home & (first_.size() - 1)];
    next_.push_back(first);
    first = static_cast<std::uint32_t>(points_.size() - 1);
}

/// Chains anew, in the order of the points, so that each is found as before.
void Welder::grow() {
    constexpr std::size_t least = 64;
    first_.assign(std::max(least, 2 * first_.size()), none);
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        std::uint32_t& first = first_[home_[k] & (first_.size() - 1)];
        next_[k] = first;
        first = k;
    }
}

} // namespace hemilux
