#pragma once
// Division of patches where the light changes within them.
//
// Rounds: the light is solved roughly on the patches there are, it is gathered at points of the
// surfaces, and the patches whose one value is furthest from what the points show are divided. The
// rounds end when the error of the division is as small as it is asked to be.

#include "bvh/tracer.h"
#include "radiosity/final_gather/division_error.h"
#include "radiosity/solving/solver.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace hemilux {

class Mesh;

struct AdaptiveDivision {
    /// Relative error of the light that the division alone may leave.
    double error = .05;
    /// Patches that are not exceeded.
    std::size_t most_patches = 1'000'000;
    std::uint64_t seed = 1;
    unsigned threads = 0;     ///< 0: one per core. The result does not depend on it.
    std::uint64_t memory = 0; ///< bytes that a solution may use for its rays; 0: no limit
    /// No round is begun after so many; it may take several times as long as all before.
    double seconds = std::numeric_limits<double>::infinity();
};

/// What was found in a round, before its patches were divided.
struct DivisionRound {
    std::size_t patches;
    DivisionError found;
    std::uint64_t rays; ///< of the rough solution and of the points
};

/// Divides the mesh; the tracer, which is of this mesh, remains right. Returns false where it was
/// interrupted: the mesh is then divided as far as the rounds before came.
bool divide_where_light_changes(Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                                Monitor& monitor,
                                const std::function<void(const DivisionRound&)>& after_round = {});

} // namespace hemilux
