#pragma once
// The middle of a list of things with centres, for trees that halve such lists.

#include "geometry/box.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace hemilux {

/// Sorts the lower half of the numbers before the upper half, by their centres along the axis on
/// which these extend most; equal ones by number. Returns how many the lower half has.
template <class CentreOf>
std::size_t halve_at_median(std::span<std::uint32_t> numbers, const CentreOf& centre_of) {
    Box centres;
    for (const std::uint32_t number : numbers)
        centres.include(centre_of(number));
    const int axis = largest_axis(centres.extent());
    const std::size_t half = numbers.size() / 2;
    std::ranges::nth_element(
        numbers, numbers.begin() + static_cast<std::ptrdiff_t>(half), {},
        [&](std::uint32_t number) { return std::pair(centre_of(number)[axis], number); });
    return half;
}

} // namespace hemilux
