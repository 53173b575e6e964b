#include "app/gathering/gathered_light.h"

#include "app/division/default_division.h"
#include "app/division/whole_error.h"
#include "app/gathering/gather_rounds.h"
#include "app/gathering/learn_options.h"
#include "app/settings/text.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "app/terminal/stopwatch.h"
#include "io/files/error.h"
#include "io/lightmaps/covered_texels.h"
#include "io/lightmaps/lightmap_gather.h"
#include "io/lightmaps/lightmap_target.h"
#include "io/rendering/picture_error.h"
#include "io/rendering/picture_parts.h"
#include "io/rendering/render.h"
#include "parallel/workers.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace hemilux {
namespace {

/// The share of the error that the noise of the rays of points may leave.
constexpr double share_of_noise = .6;

/// The most points from which the light that all of them read is learned.
constexpr std::size_t max_learned_points = 65'536;

std::vector<TargetPart> parts_of(std::span<const Sensor> sensors) {
    std::vector<TargetPart> parts;
    const std::size_t each = (sensors.size() + max_learned_points - 1) / max_learned_points;
    for (std::size_t k = 0; k < sensors.size(); k += std::max<std::size_t>(each, 1))
        parts.push_back({{sensors[k].at}, {Vec3(1.0)}});
    return parts;
}

class Gathering {
  public:
    Gathering(const SolveSettings& settings, const LitScene& scene, const Solution& solution,
              Monitor& monitor, Statistics& statistics, const std::optional<WholeLight>& whole)
        : settings_(settings), scene_(scene), solution_(solution), statistics_(statistics),
          workers_(settings.options.threads), time_(monitor.interrupted.own().wished),
          limits_(settings.stop),
          cache_(std::make_unique<LightCache>(scene.mesh, scene.tracer, solution)),
          rounds_(settings, solution, *cache_, monitor, statistics, whole) {}

    void find_points(std::span<const NamedPoint> points);
    void find_picture(const Camera& camera);
    void find_lightmap(const NamedLayout& named);
    /// Returns what was found, and enters the errors.
    [[nodiscard]] GatheredLight finish();

  private:
    [[nodiscard]] bool find_sensors(std::span<const NamedPoint> points);
    void log_end_of_points(std::size_t points) const;
    void add(const GatherErrors& errors) {
        if (!errors_ || errors.bound() > errors_->bound())
            errors_ = errors;
    }
    [[nodiscard]] std::uint64_t seed_of(std::uint64_t use) const {
        return hash_words({settings_.options.seed, use});
    }

    const SolveSettings& settings_;
    LitScene scene_;
    const Solution& solution_;
    Statistics& statistics_;
    Workers workers_;
    PictureTime time_;
    /// The light at points may take as long as the solution may, and the rays that it leaves.
    const StopRule& limits_;
    Stopwatch started_;
    std::unique_ptr<LightCache> cache_;
    GatherRounds rounds_;
    GatheredLight light_;
    bool shows_patches_ = false;         ///< some lightmap, after a signal
    std::optional<GatherErrors> errors_; ///< the larger ones of points and of the picture
};

/// Finds the faces that points lie on. Returns whether it came to the end before a signal.
bool Gathering::find_sensors(std::span<const NamedPoint> points) {
    constexpr std::size_t points_per_chunk = 1024;
    light_.sensors.resize(points.size());
    std::atomic<bool> is_over{false};
    workers_.for_chunks(points.size(), points_per_chunk, [&](std::size_t begin, std::size_t end) {
        if (is_over || time_.is_over()) {
            is_over = true;
            return;
        }
        for (std::size_t k = begin; k < end; ++k)
            light_.sensors[k] =
                sensor_at(scene_.mesh, scene_.tracer,
                          scene_.mesh.frame().to_local(points[k].position), points[k].normal);
    });
    return !is_over;
}

/// Logs why rays ended before the light at points was as exact as asked for.
void Gathering::log_end_of_points(std::size_t points) const {
    const LightAtPoints& found = light_.points;
    std::string text;
    switch (found.end) {
    case PointsEnd::right:
        return;
    case PointsEnd::gave_up:
        if (found.lights.empty()) // no table is written
            return;
        text = "interrupted";
        break;
    case PointsEnd::rays:
        text = "--max-rays ended it after " + short_counted(found.rays, "ray", "rays");
        break;
    case PointsEnd::time:
        text = "it took as long as --time lets it";
        break;
    case PointsEnd::patience:
        text = "more rays did not reduce its noise, and it ended after " +
               duration(default_patience) + "; --time or --max-rays lets it go on";
        break;
    }
    text = "the light at points: " + text;
    if (found.lights.size() < points)
        text += "; the rows of " + grouped(points - found.lights.size()) + " of " +
                grouped(points) + " points hold no light";
    else
        text += "; its noise is " + percent(found.noise);
    log_line(settings_.verbosity, Verbosity::normal, "warning: " + text);
}

void Gathering::find_points(std::span<const NamedPoint> points) {
    const Stage stage("gathering at points", settings_.verbosity);
    if (!find_sensors(points))
        return;
    GatherErrors errors{rounds_.learn(parts_of(light_.sensors), seed_of(3), limits_.seconds)};
    const Stopwatch watch;
    // The noise of few points is hardly known, and so its bound is larger.
    const double in_doubt = 1 + 1 / std::sqrt(double(std::max<std::size_t>(points.size(), 1)));
    const double error = rounds_.error_of_read(errors.read.level);
    PointLightOptions options{.noise = share_of_noise * error / in_doubt,
                              .read_error =
                                  std::isfinite(errors.read.error) ? errors.read.error : 0,
                              .seed = seed_of(2),
                              .give_up = [this] { return time_.is_over(); }};
    if (limits_.seconds)
        options.seconds = std::max(*limits_.seconds - started_.seconds(), 0.0);
    if (limits_.rays)
        options.max_all_rays =
            *limits_.rays - std::min(*limits_.rays, rays_spent(solution_, statistics_));
    if (!limits_.seconds && !limits_.rays)
        options.patience = default_patience;
    if (settings_.gather)
        options.rays = PointSettings::rays_per_gather_ray * *settings_.gather;
    light_.points =
        light_at(light_.sensors, scene_.mesh, scene_.tracer, cache_->light(), options, workers_);
    log_end_of_points(points.size());
    errors.noise = light_.points.noise;
    errors.noise_uncertainty = light_.points.noise_uncertainty;
    errors.noise_local = light_.points.noise_local;
    rounds_.end_target({errors.read.level, 0});
    statistics_.rays_gather += light_.points.rays;
    statistics_.seconds_learn += watch.seconds();
    add(errors);
}

void Gathering::find_picture(const Camera& camera) {
    const Mesh& mesh = scene_.mesh;
    const auto [width, height] = settings_.view.size;
    const CameraRays rays(camera, mesh, double(width) / height);
    const ReadError read = rounds_.learn(
        picture_parts(mesh, scene_.tracer, rays, width, height, seed_of(6), workers_), seed_of(5));
    RenderOptions options = picture_options(settings_.view.size, settings_.options.threads, time_);
    options.slope = solution_.slope;
    options.cells = &cache_->cells();
    Image picture;
    add(rounds_.gather(
        "picture", read, picture,
        [&](unsigned of_point, unsigned round, bool alone) {
            options.coarse_rays = alone ? 4 * of_point : 0;
            options.gather = of_point;
            options.gather_round = round;
            return render_view(scene_, camera, options);
        },
        judge_of_pictures(mesh, scene_.tracer, cache_->light(), rays, width, height, seed_of(7))));
    light_.picture = std::move(picture);
}

/// A signal leaves the light of patches in it.
void Gathering::find_lightmap(const NamedLayout& named) {
    const auto& [object, layout] = named;
    const Mesh& mesh = scene_.mesh;
    const SurfaceLight& light = cache_->light();
    const auto seed = [&](std::uint64_t use) {
        return light_.lightmaps.empty() ? seed_of(use)
                                        : hash_words({seed_of(use), light_.lightmaps.size()});
    };
    std::vector<PlacedTriangle> triangles = layout.triangles;
    show_brighter_sides(mesh, solution_, triangles);
    const TexelMap texels = texels_of(layout, std::move(triangles), mesh, scene_.tracer);
    LightmapOptions options{.bake = settings_.bake, .check = [this] {
                                if (time_.is_over())
                                    throw Interrupted();
                            }};
    GatheredLightmap found;
    try {
        const std::vector<bool> covered =
            find_covered(mesh, scene_.tracer, texels, options.check, workers_);
        const ReadError read = rounds_.learn(
            lightmap_parts(mesh, texels, covered, settings_.bake, seed(10)), seed(11));
        const GatherErrors errors = rounds_.gather(
            object.empty() ? "lightmap" : "lightmap of " + object, read, found.image,
            [&](unsigned of_point, unsigned round, bool) {
                options.rays = of_point;
                options.round = round;
                GatheredLightmap one =
                    gather_lightmap(mesh, scene_.tracer, light, texels, covered, options, workers_);
                found.known = std::move(one.known);
                return std::move(one.image);
            },
            judge_of_lightmaps(mesh, scene_.tracer, light, texels, covered, settings_.bake,
                               seed(12)));
        add(errors);
        if (!object.empty())
            statistics_.objects.push_back(
                {object, static_cast<std::uint64_t>(std::ranges::count(found.known, true)),
                 errors.rays, errors.whole(), errors.bound()});
    } catch (const Interrupted&) {
        if (!std::exchange(shows_patches_, true))
            log_line(settings_.verbosity, Verbosity::quiet,
                     object.empty() ? "interrupted; the lightmap shows the light of the patches"
                                    : "interrupted; the lightmaps of " + object +
                                          " and later objects show the light of the patches");
        found = lightmap_of_patches(mesh, light, texels, settings_.bake);
    }
    fill_texels(found, texels, layout.margin);
    light_.lightmaps.push_back(std::move(found.image));
}

GatheredLight Gathering::finish() {
    light_.cache = std::move(cache_);
    light_.levels = rounds_.levels();
    if (errors_)
        light_.error = errors_->whole();
    if (errors_ && gives_gathered_light(settings_)) {
        statistics_.estimated_error = errors_->whole();
        statistics_.error_bound = errors_->bound();
        statistics_.estimated_error_uncertainty = errors_->uncertainty();
        statistics_.error_local = errors_->local();
        statistics_.estimated_error_of = ErrorOf::gathered;
    }
    return std::move(light_);
}

/// Warns of objects of which no texel was judged: coordinates that fill little of a small lightmap
/// leave none within their triangles.
void warn_of_unknown_errors(const SolveSettings& settings, const Statistics& statistics) {
    const auto unknown = std::ranges::count_if(
        statistics.objects, [](const ObjectFigures& of) { return !std::isfinite(of.bound); });
    if (unknown > 0)
        log_line(settings.verbosity, Verbosity::normal,
                 "warning: the error of " +
                     counted(static_cast<std::uint64_t>(unknown), "object", "objects") +
                     " is not known, as their lightmaps have too few texels; a larger --lightmap "
                     "or --lightmap-uv new has more");
}

bool has_gathered_picture(const SolveSettings& settings) {
    return settings.gather_pictures &&
           std::ranges::any_of(settings.outputs, is_picture, &Output::kind);
}

} // namespace

bool gathers_lightmap(const SolveSettings& settings) {
    return settings.writes_lightmap() && settings.gather_pictures &&
           std::ranges::any_of(settings.outputs, is_own_file, &Output::kind);
}

bool gathers(const SolveSettings& settings) {
    return !settings.points.output.empty() || has_gathered_picture(settings) ||
           gathers_lightmap(settings);
}

GatheredLight gather_light(const SolveSettings& settings, const LitScene& scene,
                           const Solution& solution, std::span<const NamedPoint> points,
                           const Camera& camera, std::span<const NamedLayout> lightmaps,
                           Monitor& monitor, Statistics& statistics,
                           const std::optional<WholeLight>& whole) {
    if (!gathers(settings))
        return {};
    Gathering gathering(settings, scene, solution, monitor, statistics, whole);
    if (!points.empty())
        gathering.find_points(points);
    for (const NamedLayout& lightmap : lightmaps)
        if (!lightmap.layout.triangles.empty())
            gathering.find_lightmap(lightmap);
    warn_of_unknown_errors(settings, statistics);
    try {
        if (has_gathered_picture(settings))
            gathering.find_picture(camera);
    } catch (const Interrupted&) {
        return gathering.finish();
    }
    return gathering.finish();
}

} // namespace hemilux
