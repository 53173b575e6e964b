#include "radiosity/engine/shooting/shooting.h"

#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/mesh.h"

#include <chrono>

namespace hemilux {

ShootingSolver::ShootingSolver(const SolverInput& input, MakeStrategy make_strategy,
                               const ShootingRules& rules)
    : StepwiseSolver(input, rules.rays == RaysPerPatch::by_power, true),
      tools_(input, rules, input.options.depth) {
    const auto start = std::chrono::steady_clock::now();
    input_.monitor.phase = "density";
    tools_.strategy = make_strategy(input_, tools_.hemisphere, Workers(input.options.threads));
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const Strategy& strategy = *tools_.strategy;
    mean_.solution.seconds_density = elapsed.count();
    mean_.solution.rays_density = strategy.density_rays();
    mean_.solution.rays_density_spared = strategy.density_rays_spared();
    mean_.solution.bytes_density = strategy.density_bytes();
}

bool ShootingSolver::solve_once(const StepTask& task, StepResult& result) {
    Bounces bounces(tools_);
    StepHook* const hook = tools_.strategy->step_hook();
    if (!hook)
        return bounces.shoot(task, result);
    if (task.stream != pilot_stream) {
        std::vector<Vec3> light(estimate().begin(), estimate().end());
        for (std::size_t i = 0; i < task.aimed.size(); ++i)
            light[i] *= task.aimed[i];
        hook->prepare(light, task.ray_power);
    }
    hook->begin_step(task.stream); // the pilot's is after all others
    if (!bounces.shoot(task, result))
        return false;
    hook->end_step();
    mean_.solution.rays_density = tools_.strategy->density_rays();
    return true;
}

void ShootingSolver::save_more(StateWriter& state) const {
    if (const StepHook* const hook = tools_.strategy->step_hook())
        hook->save(state);
}

/// Refuses a state with far too many rays: on average over all power, a strategy gives about as
/// many rays as power alone would.
void ShootingSolver::load_more(StateReader& state) {
    constexpr double max_times = 1e3;
    StepHook* const hook = tools_.strategy->step_hook();
    if (!hook)
        return;
    hook->load(state);
    double power = 0, rays = 0;
    for (std::uint32_t i = 0; i < mean_.solution.radiosity.size(); ++i) {
        const double of_patch =
            input_.mesh.patches()[i].area * mean_of_channels(mean_.solution.radiosity[i]);
        power += of_patch;
        rays += of_patch * hook->rays_for_power(i);
    }
    if (!(rays <= max_times * power))
        throw StateError("its patches would trace far more rays than are asked for");
}

} // namespace hemilux
