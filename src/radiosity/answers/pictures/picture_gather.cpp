#include "radiosity/answers/pictures/picture_gather.h"

#include "parallel/workers.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// Light of an emitter changes as the inverse square of its distance or faster, other light more
/// slowly.
constexpr double of_emitters = 2;

/// With fewer steps than these the light changes from point to point.
constexpr double coarse_steps = 1.5;

/// Errors of means, relative to all light, from which points get more rays, or many.
constexpr double noise_for_more = .04, noise_for_many = .08;

/// Rays are aimed at bright patches from points where these have this share of the squares of the
/// light that random rays read. Such squares are the variance but for the mean.
constexpr double share_to_aim = .4;

/// The rounding error of sums of the same light in another order.
constexpr double rounding = 1e-9;

/// Spreads the bits of x to the even places.
std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 4) & 0x0f0fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
}

/// Some of many points, and the samples that each takes.
struct SomePoints {
    std::vector<std::size_t> which;
    std::vector<SurfacePoint> points;
    std::vector<GatherSamples> samples;

    void add(std::size_t number, const SurfacePoint& point, const GatherSamples& of) {
        which.push_back(number);
        points.push_back(point);
        samples.push_back(of);
    }
};

} // namespace

PictureGather::PictureGather(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                             const CameraRays& camera, int width, int height,
                             const PictureGatherOptions& options, const Workers& workers)
    : PictureGather(mesh, tracer, light,
                    GatherGrid(mesh, camera, width, height, options.check, workers), options) {}

PictureGather::PictureGather(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                             GatherGrid grid, const PictureGatherOptions& options)
    : options_(options), in_parts_(mesh, tracer, light, options.only_reflected),
      grid_(std::move(grid)), light_(grid_, tracer) {}

/// A step of the work reads what the one before has found some rows around. So each goes so many
/// rows ahead of the next, and changes nothing that the rows of an earlier step still have to read:
/// points take more rays only once all that judge by their first rays have done so.
void PictureGather::prepare_rows(int end, const Workers& workers) {
    constexpr int read_by_places = 3, asks = 1;
    const auto ahead = [&](int of, int rows) { return std::min(grid_.rows(), of + rows); };
    Done to;
    to.twice = ahead(end / GatherGrid::step, read_by_places);
    to.once = ahead(to.twice, SlowLightField::reaches_twice);
    to.more_rays = chunks_up_to(ahead(to.once, SlowLightField::reaches_once));
    to.judged = ahead(rows_of(to.more_rays), reach_points);
    to.asked = ahead(to.judged, reach_points + asks);
    to.first_rays = chunks_up_to(ahead(to.asked, asks));
    if (to.twice <= done_.twice)
        return;
    gather(
        done_.first_rays, to.first_rays, [&](int, int) { return std::max(1u, options_.rays / 4); },
        Shadows::traced, workers);
    if (to.asked > done_.asked)
        grid_.ask_neighbours(done_.asked, to.asked, workers);
    judge_points(done_.judged, to.judged, workers);
    gather(
        done_.more_rays, to.more_rays, [&](int x, int y) { return more_rays(x, y); },
        Shadows::left_out, workers);
    light_.fit_once(done_.once, to.once, options_.check, workers);
    light_.fit_twice(done_.twice, to.twice, options_.check, workers);
    done_ = to;
}

/// Points are gathered by chunks of so many, whose rays go on together: what a point gets must not
/// depend on the rows that are prepared at a time.
std::size_t PictureGather::points_of_chunk() const {
    return std::max<std::size_t>(16, 8192 / options_.rays);
}

/// Returns how many chunks there are up to row `end`.
std::size_t PictureGather::chunks_up_to(int end) const {
    const std::size_t points = static_cast<std::size_t>(end) * std::size_t(grid_.columns());
    return (points + points_of_chunk() - 1) / points_of_chunk();
}

/// Returns the rows of which so many chunks have points.
int PictureGather::rows_of(std::size_t chunks) const {
    const std::size_t points = std::min(chunks * points_of_chunk(), grid_.size()),
                      columns = std::size_t(grid_.columns());
    return static_cast<int>((points + columns - 1) / columns);
}

/// Takes the samples along a Z-curve, so that each aligned square of points has a net of the
/// sequence (Ahmed and Wonka 2020). Each block of 256 x 256 points has a sequence of its own for
/// each count and round.
GatherSamples PictureGather::samples_of(int x, int y, unsigned count) const {
    constexpr unsigned bits_of_blocks = 16;
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    const std::uint32_t place = spread_bits(column & 255u) | spread_bits(row & 255u) << 1;
    const std::uint32_t block = row >> 8 | options_.round << bits_of_blocks;
    return {hash_words({column >> 8, block, count}), place * count, count};
}

/// Gathers by rays_at(x, y) more rays at each point of some chunks.
template <class Rays>
void PictureGather::gather(std::size_t first, std::size_t end, const Rays& rays_at, Shadows shadows,
                           const Workers& workers) {
    const auto columns = static_cast<std::size_t>(grid_.columns());
    const std::size_t of_chunk = points_of_chunk();
    workers.for_chunks(end - first, 1, [&](std::size_t chunk, std::size_t) {
        options_.check();
        SomePoints some;
        const std::size_t begin = (first + chunk) * of_chunk;
        for (std::size_t k = begin; k < std::min(begin + of_chunk, grid_.size()); ++k) {
            if (grid_[k].at.facet == none)
                continue;
            const int x = static_cast<int>(k % columns), y = static_cast<int>(k / columns);
            const unsigned rays = rays_at(x, y);
            if (rays == 0)
                continue;
            GatherSamples samples = samples_of(x, y, rays);
            samples.partly_aimed = grid_[k].aims;
            some.add(k, grid_[k].at, samples);
        }
        const std::vector<IndirectLight> lights = in_parts_.indirect(some.points, some.samples);
        const std::vector<EmitterLight> direct =
            in_parts_.direct(some.points, some.samples, shadows);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            GridPoint& point = grid_[some.which[i]];
            point.rays += some.samples[i].count;
            const double share = double(some.samples[i].count) / point.rays;
            SlowLight& light = light_.at(some.which[i]);
            const glm::vec3 indirect(lights[i].irradiance);
            light.indirect =
                point.aims ? indirect : glm::mix(light.indirect, indirect, float(share));
            light.unshadowed =
                glm::mix(light.unshadowed, glm::vec3(direct[i].unshadowed), float(share));
            point.nearness = float(
                glm::mix(double(point.nearness),
                         std::max(lights[i].nearness, of_emitters * direct[i].nearness), share));
            point.squares += Vec2(lights[i].squares, lights[i].bright_squares);
            if (shadows == Shadows::left_out)
                continue;
            point.light = float(mean_of_channels(lights[i].irradiance + direct[i].arriving));
            if (direct[i].arriving != Vec3(0.0))
                point.shadow |= none_blocked;
            if (mean_of_channels(direct[i].arriving) <
                (1 - rounding) * mean_of_channels(direct[i].unshadowed))
                point.shadow |= all_blocked;
        }
    });
}

/// Returns how many more rays a point needs. They help where few points are near enough to average
/// over. They also help where few rays find most of the light, as that of a sky through a window.
unsigned PictureGather::more_rays(int x, int y) const {
    const GridPoint& here = *grid_.point(x, y);
    const bool is_coarse = here.is_coarse && options_.coarse_rays == 0;
    if (grid_.spacing(x, y) == 0 || is_coarse || here.noise > noise_for_many)
        return 4 * options_.rays;
    return here.noise > noise_for_more ? options_.rays : 0;
}

void PictureGather::judge_points(int first, int end, const Workers& workers) {
    grid_.for_each_point(first, end, workers, [&](const GridPoint& here, int x, int y) {
        GridPoint& judged = grid_[grid_.number_of(here)];
        judged.noise = float(light_.noise_around(here, x, y));
        judged.is_coarse = reach_of(here.nearness) < coarse_steps * grid_.spacing(x, y);
        Vec2 squares(0.0);
        grid_.for_each_around(here, x, y, reach_points,
                              [&](const GridPoint& there) { squares += there.squares; });
        judged.aims = squares.y > share_to_aim * squares.x;
    });
}

/// Traces shadow rays where some rays of the points around were blocked and some were not. Where no
/// point is around, it traces all rays. On a bent surface, light straight from emitters ends where
/// that turns away, also without a shadow: there each place has all of its own.
std::vector<PictureGather::Light> PictureGather::irradiance(std::span<const Place> places) const {
    SomePoints all, alone, in_penumbra;
    std::vector<Light> found(places.size());
    const unsigned each = of_sample(), of_pixel = shadow_rays();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& place = places[k];
        const int x = static_cast<int>(place.pixel.x), y = static_cast<int>(place.pixel.y);
        auto& [direct, slow, of_points, reach] = found[k];
        all.add(k, place.at, samples_of(x, y, of_pixel));
        std::optional<SlowLightField::Around> around =
            light_.interpolate(place.at, place.pixel, place.part);
        const bool by_itself = !around || (options_.coarse_rays > 0 && around->is_coarse);
        if (!by_itself) {
            slow = around->light;
        } else {
            alone.add(k, place.at,
                      samples_of(x, y, around ? options_.coarse_rays : 4 * options_.rays));
            reach = around ? around->reach : 0;
        }
        if (!by_itself && !place.at.is_raised &&
            (around->shadow == none_blocked || around->shadow == all_blocked)) {
            direct.unshadowed = Vec3(slow.unshadowed);
            direct.arriving = around->shadow == none_blocked ? direct.unshadowed : Vec3(0.0);
            continue;
        }
        GatherSamples samples = samples_of(x, y, of_pixel);
        samples.first += each * place.sample;
        samples.count = each * place.count;
        in_penumbra.add(k, place.at, samples);
    }
    const std::vector<Vec3> of_points = in_parts_.from_points(all.points, all.samples);
    for (std::size_t k = 0; k < places.size(); ++k)
        found[k].of_points = of_points[k];
    const std::vector<EmitterLight> direct =
        in_parts_.direct(in_penumbra.points, in_penumbra.samples, Shadows::traced);
    for (std::size_t i = 0; i < direct.size(); ++i) {
        const std::size_t k = in_penumbra.which[i];
        found[k].direct = direct[i];
        if (places[k].at.is_raised)
            found[k].slow.unshadowed = glm::vec3(direct[i].unshadowed);
    }
    const std::vector<IndirectLight> lights = in_parts_.indirect(alone.points, alone.samples);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light& light = found[alone.which[i]];
        light.slow = {glm::vec3(light.direct.unshadowed), glm::vec3(lights[i].irradiance)};
    }
    return found;
}

} // namespace hemilux
