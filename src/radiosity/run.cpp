#include "radiosity/mesh.h"
#include "radiosity/solver.h"

#include <chrono>

namespace hemilux {

bool run(Solver& solver, const SolverInput& input, const StopRule& stop,
         const std::function<void(const StepRecord&, const Solution&)>& after_step) {
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
        const std::chrono::duration<double> d = std::chrono::steady_clock::now() - start;
        return solver.solution().seconds_density + d.count();
    };
    double before = elapsed(), longest = 0;
    for (std::uint32_t step = 1;; ++step) {
        if (input.monitor.interrupted || !solver.step())
            return false;
        const Solution& solution = solver.solution();
        const StepRecord record{step, solution.rays_energy + solution.rays_density, elapsed(),
                                estimated_error(input.mesh, solution)};
        if (after_step)
            after_step(record, solution);
        longest = std::max(longest, record.seconds - before);
        before = record.seconds;
        if (solver.finished() || (stop.steps && step >= *stop.steps) ||
            (stop.error && record.estimated_error <= *stop.error) ||
            // A step that would end too late is not begun.
            (stop.seconds && record.seconds + longest > *stop.seconds))
            return true;
    }
}

} // namespace hemilux
