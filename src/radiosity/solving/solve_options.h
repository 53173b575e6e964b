#pragma once
// What a method is told: how many rays, which random numbers, and when the run will end.

#include "radiosity/solving/own_options.h"
#include "radiosity/solving/stop_rule.h"

#include <cstdint>

namespace hemilux {

struct SolveOptions {
    /// Mean energy rays per patch and step, N_hemi of the paper. More: fewer, longer steps.
    double rays = 64;
    /// Levels of subdivision of the hemisphere, 0 to 5: 4, 20, 84, ... triangles.
    int depth = 2;
    /// A triangle whose mean density [surfaces per ray] is higher is divided.
    double threshold = 0;
    /// The rules as printed in the paper; biased (docs/decisions.md, D1, D2, D10).
    bool literal = false;
    std::uint64_t seed = 1;
    /// How the run will end, as far as the caller knows: methods plan their steps by it. Those with
    /// independent steps work out several at the same time, and their result does not depend on it.
    StopRule stop = {};
    /// Bytes that a method may use for rays that it keeps; 0: as many as it needs.
    std::uint64_t memory = 0;
    /// 0: one per core. The result does not depend on it.
    unsigned threads = 0;
    /// Leaves out nothing that the scene does not need (needs.h): for comparison.
    bool keep_all = false;
    OwnOptions own = {}; ///< of single methods, as own.of<ProgressiveOptions>()
};

} // namespace hemilux
