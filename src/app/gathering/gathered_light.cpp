#include "app/gathering/gathered_light.h"

#include "app/division/whole_error.h"
#include "app/gathering/gather_rounds.h"
#include "app/gathering/learn_options.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "geometry/elementary.h"
#include "io/files/error.h"
#include "parallel/asked_to_end.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/lightmaps/covered_texels.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/lightmap_target.h"
#include "radiosity/answers/pictures/picture_error.h"
#include "radiosity/answers/pictures/picture_parts.h"
#include "radiosity/answers/pictures/render.h"
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
              Monitor& monitor, Statistics& statistics, const std::optional<WholeLight>& whole,
              ShowRows show_rows)
        : settings_(settings), scene_(scene), solution_(solution), statistics_(statistics),
          workers_(settings.options.threads), interrupted_(monitor.interrupted.own().wished),
          limits_(settings.stop), show_rows_(std::move(show_rows)),
          cache_(std::make_unique<LightCache>(scene.mesh, scene.tracer, solution)),
          rounds_(settings, solution, *cache_, monitor, statistics, whole) {}

    void find_points(std::span<const NamedPoint> points);
    void find_picture(const Camera& camera);
    void find_lightmap(const NamedLayout& named);
    /// Returns what was found, and enters the errors.
    [[nodiscard]] GatheredLight finish();

  private:
    void find_sensors(std::span<const NamedPoint> points);
    void limit(PointLightOptions& options) const;
    void take_light_of_patches();
    void log_end_of_points(std::size_t gathered, bool by_default) const;
    void complete(RowsOfPicture picture, const Camera& camera);
    void log_patches_in_lightmap(const std::string& object, int rows, int size) const;
    void add(const GatherErrors& errors) {
        if (errors.is_unknown())
            return;
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
    const std::atomic<bool>& interrupted_;
    /// The light at points may take as long as the solution may, and the rays that it leaves.
    const StopRule& limits_;
    ShowRows show_rows_;           ///< may be empty
    std::atomic<double> share_{0}; ///< of the work at points that is done
    Stopwatch started_;
    std::unique_ptr<LightCache> cache_;
    GatherRounds rounds_;
    GatheredLight light_;
    bool shows_patches_ = false;         ///< some lightmap, after a signal
    std::optional<GatherErrors> errors_; ///< the larger ones of points and of the picture
};

/// Finds the faces that points lie on.
void Gathering::find_sensors(std::span<const NamedPoint> points) {
    constexpr std::size_t points_per_chunk = 1024;
    light_.sensors.resize(points.size());
    workers_.for_chunks(points.size(), points_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            light_.sensors[k] =
                sensor_at(scene_.mesh, scene_.tracer,
                          scene_.mesh.frame().to_local(points[k].position), points[k].normal);
    });
}

/// Without a limit of the user's, points take at most so many rays: as many as a run of some
/// minutes has, or some times those of the solution, or of what each point needs at the least.
void Gathering::limit(PointLightOptions& options) const {
    constexpr std::uint64_t least = 50'000'000, times_solution = 4, times_first = 64;
    if (limits_.seconds)
        options.seconds = std::max(*limits_.seconds - started_.seconds(), 0.0);
    if (limits_.rays)
        options.max_all_rays =
            *limits_.rays - std::min(*limits_.rays, rays_spent(solution_, statistics_));
    if (!limits_.seconds && !limits_.rays && !settings_.gather)
        options.max_all_rays =
            std::max({least, times_solution * solution_.rays_energy,
                      times_first * first_rays_of_point * std::uint64_t(light_.sensors.size())});
}

/// Gives the points at which nothing was gathered the light of the patch on which they lie. How far
/// such light is off is seen at the points that were gathered; without any, it may be all wrong.
void Gathering::take_light_of_patches() {
    std::vector<PointLight>& lights = light_.points.lights;
    const auto of_patch = [&](const Sensor& sensor) {
        return cache_->light().irradiance(sensor.patch, sensor.at.position).value;
    };
    const std::size_t gathered = lights.size();
    Vec3 squares(0.0);
    double count = 0;
    for (std::size_t k = 0; k < gathered; ++k) {
        const Sensor& sensor = light_.sensors[k];
        if (sensor.patch == none)
            continue;
        const Vec3 off = of_patch(sensor) - lights[k].irradiance;
        squares += off * off + lights[k].standard_error * lights[k].standard_error;
        ++count;
    }
    for (std::size_t k = gathered; k < light_.sensors.size(); ++k) {
        const Sensor& sensor = light_.sensors[k];
        PointLight& light = lights.emplace_back();
        light.is_known = sensor.patch != none;
        if (!light.is_known)
            continue;
        light.irradiance = of_patch(sensor);
        light.standard_error = count > 0 ? glm::sqrt(squares / count) : light.irradiance;
    }
}

/// Logs why rays ended before the light at points was as exact as asked for, and what the rows
/// hold.
void Gathering::log_end_of_points(std::size_t gathered, bool by_default) const {
    const LightAtPoints& found = light_.points;
    const std::size_t points = found.lights.size();
    std::string text = "the light at points: ";
    switch (found.end) {
    case PointsEnd::right:
        return;
    case PointsEnd::gave_up:
        text += "interrupted";
        break;
    case PointsEnd::rays:
        text += (by_default ? "it ended" : "--max-rays ended it") + std::string(" after ") +
                short_counted(found.rays, "ray", "rays");
        text +=
            by_default ? ", which is the limit by default; --max-rays or --time sets another" : "";
        break;
    case PointsEnd::time:
        text += "it took as long as --time lets it";
        break;
    }
    if (gathered == points)
        text += "; its noise is " + percent(found.noise);
    else if (gathered > 0)
        text += "; points 0 to " + grouped(gathered - 1) + " of " + grouped(points) +
                " are gathered, the others have the light of the patches that they lie on";
    else
        text += "; all points have the light of the patches that they lie on";
    if (const auto empty = std::ranges::count(found.lights, false, &PointLight::is_known);
        empty > 0)
        text += "; the rows of " + counted(static_cast<std::uint64_t>(empty), "point", "points") +
                " away from them hold no light";
    log_line(settings_.verbosity, Verbosity::normal, "warning: " + text);
}

void Gathering::find_points(std::span<const NamedPoint> points) {
    find_sensors(points);
    GatherErrors errors{rounds_.learn(parts_of(light_.sensors), seed_of(3), limits_.seconds)};
    const Stopwatch watch;
    // The noise of few points is hardly known, and so its bound is larger.
    const double in_doubt = 1 + 1 / std::sqrt(double(std::max<std::size_t>(points.size(), 1)));
    const double error = rounds_.error_of_read(errors.read.level);
    PointLightOptions options{.noise = share_of_noise * error / in_doubt,
                              .read_error =
                                  std::isfinite(errors.read.error) ? errors.read.error : 0,
                              .seed = seed_of(2),
                              .give_up = [this] { return is_asked_to_end(interrupted_); },
                              .share = &share_};
    limit(options);
    if (settings_.gather)
        options.rays = PointSettings::rays_per_gather_ray * *settings_.gather;
    {
        const Stage stage("gathering at points", settings_.verbosity, share_);
        light_.points = light_at(light_.sensors, scene_.mesh, scene_.tracer, cache_->light(),
                                 options, workers_);
    }
    // Where a signal came before what is read was judged, its error is that of the patches.
    if (!std::isfinite(errors.read.error) && std::isfinite(statistics_.estimated_error))
        for (PointLight& light : light_.points.lights)
            for (int c = 0; c < 3; ++c)
                light.standard_error[c] = elementary::hypot(
                    light.standard_error[c], statistics_.estimated_error * light.irradiance[c]);
    const std::size_t gathered = light_.points.lights.size();
    take_light_of_patches();
    log_end_of_points(gathered, !limits_.rays);
    if (gathered == points.size())
        errors.noise = light_.points.noise;
    errors.noise_uncertainty = light_.points.noise_uncertainty;
    errors.noise_bound = errors.noise + errors.noise_uncertainty;
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
    RenderOptions options =
        picture_options(settings_.view.size, settings_.options.threads, interrupted_);
    options.slope = solution_.slope;
    options.cells = &cache_->cells();
    Image picture;
    RowsOfPicture before_signal;
    const auto gather = [&](const GatherRounds::Round& round) {
        options.coarse_rays = round.alone ? 4 * round.rays : 0;
        options.gather = round.rays;
        options.gather_round = round.number;
        options.rows_done = [&](const Image& rows, int count) {
            round.tell(double(count) / options.height);
            if (show_rows_ && round.number == 0)
                show_rows_(rows, count);
        };
        RowsOfPicture found = render_gathered(scene_, camera, options);
        if (found.rows == options.height)
            return std::move(found.image);
        if (round.number == 0)
            before_signal = std::move(found);
        throw Interrupted();
    };
    try {
        add(rounds_.gather("picture", read, picture, gather,
                           judge_of_pictures(mesh, scene_.tracer, cache_->light(), rays, width,
                                             height, seed_of(7))));
        light_.picture = std::move(picture);
    } catch (const Interrupted&) {
        if (before_signal.rows > 0)
            complete(std::move(before_signal), camera);
    }
}

/// Takes a picture of which some rows are gathered; the others get the light of the patches.
void Gathering::complete(RowsOfPicture picture, const Camera& camera) {
    RenderOptions options =
        picture_options(settings_.view.size, settings_.options.threads, interrupted_);
    options.slope = solution_.slope;
    const Image of_patches = render_view(scene_, camera, options);
    std::ranges::copy(of_patches.pixels.begin() +
                          static_cast<std::ptrdiff_t>(of_patches.index(0, picture.rows)),
                      of_patches.pixels.end(),
                      picture.image.pixels.begin() +
                          static_cast<std::ptrdiff_t>(of_patches.index(0, picture.rows)));
    log_line(settings_.verbosity, Verbosity::quiet,
             "interrupted; rows 1 to " + grouped(static_cast<std::uint64_t>(picture.rows)) +
                 " of " + grouped(static_cast<std::uint64_t>(picture.image.height)) +
                 " of pictures are gathered, the others show the light of the patches" +
                 squares_text(settings_.view.size));
    light_.picture = std::move(picture.image);
}

/// Logs that a signal left so many rows of a lightmap.
void Gathering::log_patches_in_lightmap(const std::string& object, int rows, int size) const {
    std::string text = "interrupted; ";
    const std::string later = object.empty() ? "" : " and later objects";
    if (rows == 0)
        text += (object.empty() ? "the lightmap shows"
                                : "the lightmaps of " + object + later + " show") +
                " the light of the patches";
    else
        text += "rows 1 to " + grouped(static_cast<std::uint64_t>(rows)) + " of " +
                grouped(static_cast<std::uint64_t>(size)) + " of the lightmap" +
                (object.empty() ? "" : " of " + object) + " are gathered, the others" + later +
                " show the light of the patches";
    log_line(settings_.verbosity, Verbosity::quiet, text);
}

/// A signal leaves the light of patches in the rows that are not gathered.
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
                                if (is_asked_to_end(interrupted_))
                                    throw Interrupted();
                            }};
    GatheredLightmap found(texels);
    try {
        const std::vector<bool> covered =
            find_covered(mesh, scene_.tracer, texels, options.check, workers_);
        const ReadError read = rounds_.learn(
            lightmap_parts(mesh, texels, covered, settings_.bake, seed(10)), seed(11));
        const GatherErrors errors = rounds_.gather(
            object.empty() ? "lightmap" : "lightmap of " + object, read, found.image,
            [&](const GatherRounds::Round& round) {
                options.rays = round.rays;
                options.round = round.number;
                options.rows_done = [&](int rows) { round.tell(double(rows) / texels.size()); };
                GatheredLightmap one =
                    gather_lightmap(mesh, scene_.tracer, light, texels, covered, options, workers_);
                if (one.rows == texels.size()) {
                    found.known = std::move(one.known);
                    found.rows = one.rows;
                    return std::move(one.image);
                }
                if (round.number == 0)
                    found = std::move(one);
                throw Interrupted();
            },
            judge_of_lightmaps(mesh, scene_.tracer, light, texels, covered, settings_.bake,
                               seed(12)));
        add(errors);
        if (!object.empty() && !errors.is_unknown())
            statistics_.objects.push_back(
                {object, static_cast<std::uint64_t>(std::ranges::count(found.known, true)),
                 errors.rays, errors.whole(), errors.bound()});
    } catch (const Interrupted&) {
        if (!std::exchange(shows_patches_, true))
            log_patches_in_lightmap(object, found.rows, texels.size());
        complete_by_patches(found, mesh, light, texels, settings_.bake, workers_);
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
                           const std::optional<WholeLight>& whole, const ShowRows& show_rows) {
    if (!gathers(settings))
        return {};
    Gathering gathering(settings, scene, solution, monitor, statistics, whole, show_rows);
    if (!points.empty())
        gathering.find_points(points);
    for (const NamedLayout& lightmap : lightmaps)
        if (!lightmap.layout.triangles.empty())
            gathering.find_lightmap(lightmap);
    warn_of_unknown_errors(settings, statistics);
    if (has_gathered_picture(settings))
        gathering.find_picture(camera);
    return gathering.finish();
}

} // namespace hemilux
