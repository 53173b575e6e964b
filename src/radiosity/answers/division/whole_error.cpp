#include "radiosity/answers/division/whole_error.h"

#include "geometry/elementary.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solution/error_spread.h"

#include <cmath>

namespace hemilux {
namespace {

/// Rays to find out the error of the division: at most one in so many of all before.
constexpr std::uint64_t share_of_rays = 2;

/// The relative error of the division below which errors are not resolved where nothing asks for it
/// [-].
constexpr double resolved_on_fixed_patches = .01;

} // namespace

double WholeError::error() const { return elementary::hypot(sampling, division.error); }

double WholeError::uncertainty() const {
    return elementary::hypot(sampling * sampling_uncertainty,
                             division.error * division.uncertainty) /
           error();
}

WholeError error_of_sampling(const Mesh& mesh, const Solution& solution) {
    const double error = estimated_error(mesh, solution);
    return {.sampling = error,
            .sampling_uncertainty = error * error_spread(mesh, solution).uncertainty()};
}

void find_error_of_division(WholeError& error, const Divided& divided, const Solution& solution,
                            const WholeErrorChoices& choices, const StopFlag& interrupted) {
    if (divided.error && solution.steps == divided.steps) {
        error.division = *divided.error;
        return;
    }
    if (solution.steps == 0 || interrupted)
        return;
    const Stopwatch watch;
    DivisionErrorOptions options{
        .seed = hash_words({choices.seed, 1}),
        .max_rays =
            (solution.rays_energy + solution.rays_density + divided.work.rays) / share_of_rays,
        .negligible = choices.is_asked_for ? 0 : resolved_on_fixed_patches};
    if (error.sampling > 2 * options.negligible) // unknown after one step
        options.negligible = error.sampling / 2;
    const Problem& problem = *divided.problem;
    error.division = division_error(*problem.mesh, *problem.tracer, solution, options,
                                    Workers(choices.threads), interrupted);
    error.rays = error.division.rays;
    error.seconds = watch.seconds();
}

std::optional<Finding> whole_error_finding(double asked, const WholeError& error,
                                           const std::string& more_patches) {
    if (error.error() <= asked || !std::isfinite(error.division.error))
        return {};
    const std::string most =
        error.division.error > error.sampling
            ? "the division, which more patches (" + more_patches + ") make less"
            : "sampling, which more rays (--max-rays, --time) make less";
    return Finding{Finding::Kind::warning,
                   "the run ended before the whole error of " + percent(asked) + " was reached",
                   "most of what is left is of " + most};
}

} // namespace hemilux
