#pragma once
// The middle of a list of things with centres, for trees that halve such lists.

#include "geometry/box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace hemilux {

/// Sorts the lower half of the numbers before the upper half, by their centres along the axis on
/// which these extend most. Centres that are equal but for rounding are sorted by number. Each
/// half is left in the order of its numbers. Returns how many numbers the lower half has.
template <class CentreOf>
std::size_t halve_at_median(std::span<std::uint32_t> numbers, const CentreOf& centre_of) {
    Box centres;
    for (const std::uint32_t number : numbers)
        centres.include(centre_of(number));
    const int axis = largest_axis(centres.extent());
    const double low = centres.low[axis], extent = centres.extent()[axis];
    // The steps' offset keeps the rows of a grid away from where steps begin.
    constexpr double steps = 1 << 16, offset = .3183;
    const auto place = [&](std::uint32_t number) {
        const double along = (centre_of(number)[axis] - low) / extent;
        return extent > 0 ? std::floor(steps * along + offset) : 0;
    };
    const std::size_t half = numbers.size() / 2;
    const auto precedes = [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(place(a), a) < std::pair(place(b), b);
    };
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(half);
    std::nth_element(numbers.begin(), middle, numbers.end(), precedes);
    std::sort(numbers.begin(), middle); // libraries leave the halves in different orders
    std::sort(middle, numbers.end());
    return half;
}

} // namespace hemilux
