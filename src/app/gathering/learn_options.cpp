#include "app/gathering/learn_options.h"

#include "radiosity/paper/solution/solution.h"

#include <algorithm>

namespace hemilux {

std::uint64_t rays_spent(const Solution& solution, const Statistics& statistics) {
    return solution.rays_energy + solution.rays_density + statistics.rays_divide +
           statistics.rays_division_error + statistics.rays_learn + statistics.rays_gather;
}

LearnOptions learn_options(const SolveSettings& settings, double error, std::uint64_t seed,
                           const Solution& solution, const Statistics& statistics) {
    LearnOptions options{.seed = seed, .error = error, .accuracy = settings.error_accuracy};
    if (settings.stop.rays)
        options.max_rays =
            *settings.stop.rays - std::min(rays_spent(solution, statistics), *settings.stop.rays);
    return options;
}

} // namespace hemilux
