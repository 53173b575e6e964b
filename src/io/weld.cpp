#include "io/weld.h"

#include "bvh/tracer.h"
#include "radiosity/rng.h"

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
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    const auto [entry, is_new] = first_.try_emplace(home, number);
    next_.push_back(is_new ? none : entry->second);
    entry->second = number;
    return number;
}

std::uint32_t Welder::find(const Vec3& point, std::uint64_t cell) const {
    const auto entry = first_.find(cell);
    std::uint32_t number = entry == first_.end() ? none : entry->second;
    while (number != none && !(glm::distance(points_[number], point) <= distance_))
        number = next_[number];
    return number;
}

} // namespace hemilux
