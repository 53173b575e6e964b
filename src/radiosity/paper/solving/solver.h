#pragma once
// Defines a solver: it takes steps, each of which improves the solution.

#include "bvh/tracer.h"
#include "radiosity/paper/scene/needs.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/solve_options.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <atomic>
#include <cstdint>
#include <span>

namespace hemilux {

class Mesh;

/// The means by which a caller watches a run and ends it early. All members may be used from any
/// thread.
struct Monitor {
    std::atomic<std::uint64_t> rays{0};         ///< traced so far, density rays included
    StopFlag interrupted;                       ///< set by the caller: stop as soon as possible
    std::atomic<double> step_share{0};          ///< how much of the present step is done, 0 to 1
    std::atomic<const char*> phase{"starting"}; ///< a word for the progress bar
};

/// The input of a solver; all of it outlives the solver.
struct SolverInput {
    const Mesh& mesh;
    const Tracer& tracer;
    const SolveOptions& options;
    Monitor& monitor;
    const Needs& needs = everything_needed; ///< needs of this mesh: the rest may be left out
    /// The weight of each patch, Solution::weight, for methods that take one (Method::aims). It is
    /// empty where all are 1.
    std::span<const double> target = {};
};

class Solver {
  public:
    virtual ~Solver() = default;
    /// Improves the solution. Returns false when interrupted: the solution is then that of the
    /// steps before.
    virtual bool step() = 0;
    [[nodiscard]] virtual const Solution& solution() const = 0;
    /// Returns whether the solver stops by itself, e.g. as nothing is left to shoot.
    [[nodiscard]] virtual bool finished() const { return false; }
};

} // namespace hemilux
