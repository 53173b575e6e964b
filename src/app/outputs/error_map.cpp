#include "app/outputs/error_map.h"

#include "app/rendering/view.h"
#include "io/drawings/density_picture.h"
#include "io/files/error.h"
#include "io/pictures/picture_files.h"
#include "parallel/workers.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// Limits errors to the largest of 99 patches in 100: a few patches in gaps must not hide all
/// others.
void limit_to_most(std::vector<double>& errors) {
    constexpr double most = .99;
    std::vector<double> sorted = errors;
    const auto rank = static_cast<std::ptrdiff_t>(most * static_cast<double>(sorted.size() - 1));
    std::ranges::nth_element(sorted, sorted.begin() + rank);
    const double limit = sorted[static_cast<std::size_t>(rank)];
    if (limit > 0)
        for (double& error : errors)
            error = std::min(error, limit);
}

} // namespace

void write_error_map(const std::string& path, const ViewSettings& view, const Results& results) {
    const Mesh& mesh = results.mesh;
    const Tracer& tracer = results.tracer;
    const SolveOptions& options = results.options;
    StopFlag& interrupted = results.monitor.interrupted;
    const Camera camera = camera_of(view, results.lit());
    std::vector<double> errors =
        patch_error_levels(mesh, tracer, results.solution, hash_words({options.seed, 3}),
                           Workers(options.threads), interrupted);
    if (errors.empty())
        throw Interrupted();
    limit_to_most(errors);
    for (double& error : errors)
        error *= 100;
    write_png(path,
              render_in_time(picture_options(view.size, options.threads, interrupted.own().wished),
                             [&](const RenderOptions& in_time) {
                                 return density_picture(
                                     mesh, tracer, errors,
                                     "error of patches, % of the mean light (root mean square)",
                                     camera, in_time);
                             }),
              1);
}

} // namespace hemilux
