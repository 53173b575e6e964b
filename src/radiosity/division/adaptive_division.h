#pragma once
// Division of patches where the light changes within them.
//
// Rounds: the light of a rough solution is gathered at points of the patches that are new, and the
// patches on which it varies most are divided. Pieces send on what their patch sent, until there
// are so many of them that the light is solved anew. The rounds end when what varies within patches
// is as small as it is asked to be.

#include "bvh/tracer.h"
#include "radiosity/solving/solver.h"

#include <cstddef>
#include <cstdint>
#include <functional>

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
};

/// What was found in a round, before its patches were divided.
struct DivisionRound {
    std::size_t patches;
    double error;       ///< of the division, from few points a patch
    std::uint64_t rays; ///< of the rough solution, where there was a new one, and of the points
};

/// When a solution is good enough to divide by, or cannot be made so.
[[nodiscard]] StopRule rough_stop(const AdaptiveDivision& options, std::size_t patches);

/// A solution that is good enough to divide by, of the mesh as it is. No steps: none was found.
[[nodiscard]] Solution rough_solution(const Mesh& mesh, const Tracer& tracer,
                                      const AdaptiveDivision& options, Monitor& monitor);

/// Divides the mesh; the tracer, which is of this mesh, remains right. `solution`: of the mesh as
/// it is, and then of the divided one: pieces have what their patch had. Returns whether patches
/// were divided. Where it was interrupted the mesh is divided as far as the rounds before came.
bool divide_where_light_changes(Mesh& mesh, const Tracer& tracer, Solution& solution,
                                const AdaptiveDivision& options, Monitor& monitor,
                                const std::function<void(const DivisionRound&)>& after_round = {});

} // namespace hemilux
