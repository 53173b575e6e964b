#include "radiosity/division/adaptive_division.h"

#include "radiosity/division/patch_levels.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/scene/needs.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace hemilux {
namespace {

constexpr unsigned most_rounds = 12;

/// A round makes so many times more patches at the most, as its errors are known but roughly, and
/// at the least, as it costs as much as the patches that it would spare.
constexpr double most_growth = 4, least_growth = 1.15;
constexpr std::size_t least_room = 256;

/// The rough solution's error: it is no part of what is looked for, and it must not hide it.
constexpr double first_aim = .05, aim_of_error = .5;

Solution rough_solution(const Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                        double aim, Monitor& monitor) {
    const Needs needs = find_needs(mesh);
    SolveOptions solve;
    solve.seed = options.seed;
    solve.threads = options.threads;
    solve.aim = aim;
    solve.memory = options.memory;
    const auto solver = find_method("gathering")->make({mesh, tracer, solve, monitor, needs});
    constexpr std::uint64_t rays_of_patch = 4096, least_rays = 4'000'000;
    run(*solver, {mesh, tracer, solve, monitor, needs},
        {.steps = {},
         .seconds = {},
         .error = aim,
         .rays = least_rays + rays_of_patch * mesh.patches().size()});
    return solver->solution();
}

} // namespace

bool divide_where_light_changes(Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                                Monitor& monitor,
                                const std::function<void(const DivisionRound&)>& after_round) {
    const Workers workers(options.threads);
    double aim = std::max(first_aim, aim_of_error * options.error);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const auto is_late = [&] {
        return std::chrono::duration<double>(Clock::now() - begin).count() > options.seconds;
    };
    for (unsigned round = 0; round < most_rounds && !is_late(); ++round) {
        const Solution solution = rough_solution(mesh, tracer, options, aim, monitor);
        if (monitor.interrupted)
            return false;
        if (solution.steps == 0)
            return true;
        monitor.phase = "dividing";
        const std::size_t patches = mesh.patches().size();
        const PatchErrors errors =
            patch_errors(mesh, tracer, solution, hash_words({options.seed, 2, round}), workers,
                         monitor.interrupted);
        if (monitor.interrupted)
            return false;
        if (after_round)
            after_round({patches, errors.whole, solution.rays_energy + errors.whole.rays});
        if (!(errors.whole.error > options.error))
            return true;
        const auto times = [&](double growth) {
            return static_cast<std::size_t>(growth * static_cast<double>(patches));
        };
        const std::vector<std::uint8_t> levels = levels_of_division(
            errors.square,
            {.goal = options.error * options.error,
             .least_pieces = times(least_growth),
             .most_pieces = std::min(options.most_patches, times(most_growth) + least_room)});
        if (std::ranges::none_of(levels, [](std::uint8_t level) { return level > 0; }))
            return true;
        mesh.refine(levels);
        aim = std::clamp(aim_of_error * errors.whole.error, aim_of_error * options.error, aim);
    }
    return true;
}

} // namespace hemilux
