#pragma once
// Finds which patches exchange light with each other, directly or through others, as far as the
// stored rays know. Reported errors need it: each part answers for the light that its own rays may
// have missed (transport_errors.h).

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class RayCounts;

struct LinkedParts {
    std::vector<std::uint32_t> of; ///< part of each patch
    std::uint32_t count = 0;
};

/// Finds the parts in O(entries) time. Two patches are of one part if a ray has passed between
/// them, or between each of them and a third. Parts are numbered in the order of their first
/// patches.
[[nodiscard]] LinkedParts find_linked_parts(std::span<const RayCounts> batches);

} // namespace hemilux
