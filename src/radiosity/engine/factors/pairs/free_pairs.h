#pragma once
// The pairs of patches that face each other, what they exchange where nothing stands between them,
// and whether that is so: without chance.

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

struct FreePair {
    std::uint32_t to;
    bool is_clear;   ///< nothing stands between the two
    double exchange; ///< A F without anything between them [square of the unit of length]
};

struct FreePairs {
    std::vector<std::vector<FreePair>> rows;  ///< by patch those of higher index, ascending
    std::uint64_t clear_count = 0, count = 0; ///< pairs
};

/// Finds them. Of a pair that is clear neither a facet nor a pane of the scene reaches into the
/// hull. The tree must be that of the mesh. Work and memory grow as the square of the patches. The
/// result is void if the monitor was interrupted.
[[nodiscard]] FreePairs find_free_pairs(const Mesh& mesh, const WideBvh& tree,
                                        const Workers& workers, Monitor& monitor);

} // namespace hemilux
