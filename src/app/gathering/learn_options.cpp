#include "app/gathering/learn_options.h"

#include "radiosity/paper/solution/solution.h"

#include <algorithm>

namespace hemilux {

LearnOptions learn_options(const SolveSettings& settings, double error, std::uint64_t seed,
                           const Solution& solution, const Statistics& statistics) {
    LearnOptions options{.seed = seed, .error = error, .accuracy = settings.error_accuracy};
    if (settings.stop.rays) {
        const std::uint64_t spent = solution.rays_energy + solution.rays_density +
                                    statistics.rays_divide + statistics.rays_division_error +
                                    statistics.rays_learn + statistics.rays_gather;
        options.max_rays = *settings.stop.rays - std::min(spent, *settings.stop.rays);
    }
    return options;
}

} // namespace hemilux
