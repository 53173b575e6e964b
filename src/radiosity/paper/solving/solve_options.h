#pragma once
// Holds the options of all methods: how many rays, which random numbers, and when the run will end.

#include "radiosity/paper/solving/stop_rule.h"

#include <cstdint>
#include <memory>

namespace hemilux {

class OwnOptions; // engine/solving/own_options.h

struct SolveOptions {
    /// The mean number of energy rays per patch and step, N_hemi of the paper. More of them mean
    /// fewer, longer steps.
    double rays = 64;
    /// The number of levels of subdivision of the hemisphere, 0 to 5: 4, 20, 84, ... triangles.
    int depth = 2;
    /// A triangle whose mean density [surfaces per ray] is higher is divided.
    double threshold = 0;
    /// The method follows the rules as printed in the paper; it is biased (docs/paper/decisions.md,
    /// D1, D2, D10).
    bool literal = false;
    std::uint64_t seed = 1;
    /// The rule that will end the run, as far as the caller knows: methods plan their steps by it.
    /// Those with independent steps work out several at the same time, and their result does not
    /// depend on it.
    StopRule stop = {};
    /// The bytes that a method may use for rays that it keeps; 0 means as many as it needs.
    std::uint64_t memory = 0;
    /// The number of threads; 0 means one per core. The result does not depend on it.
    unsigned threads = 0;
    /// The method leaves out nothing that the scene does not need (needs.h), for comparison.
    bool keep_all = false;
    std::shared_ptr<const OwnOptions> own = {}; ///< those of single methods of the engine
};

} // namespace hemilux
