#include "app/gathering/gathered_light.h"

#include "app/division/whole_error.h"
#include "app/terminal/log.h"
#include "radiosity/answers/asked/text.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Returns the rays of the solution and of all that the statistics count.
std::uint64_t rays_spent(const Solution& solution, const Statistics& statistics) {
    return solution.rays_energy + solution.rays_density + statistics.rays_divide +
           statistics.rays_division_error + statistics.rays_learn + statistics.rays_gather;
}

Asked asked_of(const SolveSettings& settings, double error, const Solution& solution,
               const Statistics& statistics) {
    Asked asked{.error = error,
                .accuracy = settings.error_accuracy,
                .rays = settings.gather,
                .seed = settings.options.seed,
                .threads = settings.options.threads,
                .seconds = settings.stop.seconds};
    if (settings.stop.rays)
        asked.max_rays =
            *settings.stop.rays - std::min(rays_spent(solution, statistics), *settings.stop.rays);
    return asked;
}

void add_work(Statistics& statistics, const Work& work) {
    statistics.rays_learn += work.rays_learn;
    statistics.rays_gather += work.rays_gather;
    statistics.seconds_learn += work.seconds_learn;
    statistics.seconds_gather += work.seconds_gather;
}

/// Makes this the error of the run.
void enter(Statistics& statistics, const AnswerError& error) {
    statistics.estimated_error = error.whole;
    statistics.error_bound = error.bound;
    statistics.estimated_error_uncertainty = error.uncertainty;
    statistics.error_local = error.local;
}

} // namespace

bool gathers_picture(const SolveSettings& settings) {
    return settings.gather_pictures &&
           std::ranges::any_of(settings.outputs, is_picture, &Output::kind);
}

bool gathers_lightmap(const SolveSettings& settings) {
    return settings.writes_lightmap() && settings.gather_pictures &&
           std::ranges::any_of(settings.outputs, is_own_file, &Output::kind);
}

bool gathers(const SolveSettings& settings) {
    return !settings.points.output.empty() || gathers_picture(settings) ||
           gathers_lightmap(settings);
}

bool gathers_target(const SolveSettings& settings) {
    const TargetSettings& target = settings.target;
    return !target.camera && (!target.groups.empty() || !target.points.empty()) &&
           !settings.divide_auto && !settings.stop.steps;
}

Asked asked_of_gathers(const SolveSettings& settings, const Solution& solution,
                       const Statistics& statistics) {
    return asked_of(settings, error_of_gathered(settings), solution, statistics);
}

Asked asked_of_target(const SolveSettings& settings, const Solution& solution,
                      const Statistics& statistics) {
    constexpr double usual_error = .01;
    return asked_of(settings, settings.stop.error.value_or(usual_error), solution, statistics);
}

std::vector<WantedPoint> wanted_points(std::span<const NamedPoint> points) {
    std::vector<WantedPoint> wanted;
    for (const NamedPoint& point : points)
        wanted.push_back({point.position, point.normal});
    return wanted;
}

void add_gathered(Statistics& statistics, const SolveSettings& settings,
                  const GatheredLight& gathered) {
    Work work = gathered.work();
    // What points take is all to learn their light: their rays are not those of pictures.
    const double at_points = gathered.points ? gathered.points->work.seconds_gather : 0;
    work.seconds_learn += at_points;
    work.seconds_gather -= at_points;
    add_work(statistics, work);
    for (const auto& [light, error, took] : gathered.lightmaps)
        if (!light.object.empty() && !std::isnan(error.whole))
            statistics.objects.push_back(
                {light.object, light.texels, light.rays, error.whole, error.bound});
    const AnswerError error = gathered.largest_error();
    if (!std::isnan(error.whole) && gives_gathered_light(settings)) {
        enter(statistics, error);
        statistics.estimated_error_of = ErrorOf::gathered;
    }
    if (gathered.points)
        statistics.answers.push_back({"points", gathered.points->error});
    if (gathered.picture)
        statistics.answers.push_back({"picture", gathered.picture->error});
}

void add_target(Statistics& statistics, const Answer<Solution>& gathered) {
    enter(statistics, gathered.error);
    add_work(statistics, gathered.work);
}

void log_error_of_points(const SolveSettings& settings, const GatheredLight& gathered) {
    if (!gathered.points || gives_gathered_light(settings))
        return;
    const AnswerError& error = gathered.points->error;
    log_line(settings.verbosity, Verbosity::normal,
             "the light at points: estimated error " + percent(error.whole) +
                 (std::isfinite(error.bound) ? ", surely below " + percent(error.bound) : ""));
}

} // namespace hemilux
