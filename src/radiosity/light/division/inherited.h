#pragma once
// Pieces inherit values from the patch that they were cut from.

#include "radiosity/paper/solution/solution.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// Returns, by new patch, what the patch had that it is a piece of; `parents` as of Mesh::refine().
template <class Value>
[[nodiscard]] std::vector<Value> inherited(const std::vector<Value>& values,
                                           std::span<const std::uint32_t> parents) {
    std::vector<Value> of_pieces;
    of_pieces.reserve(parents.size());
    for (const std::uint32_t parent : parents)
        of_pieces.push_back(values[parent]);
    return of_pieces;
}

/// Makes a solution of the divided mesh that is the same function on the surfaces. Sums over the
/// area stay as they are.
void inherit(Solution& solution, std::span<const std::uint32_t> parents);

} // namespace hemilux
