#include "io/pictures/picture_gather.h"

#include "io/files/error.h"
#include "parallel/workers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

constexpr Vec2 pixel_centre(.5);

/// Of the harmonic mean distance: as far as that the light is taken to be about the same.
constexpr double reach_share = .25;

/// Light of a lamp changes as its inverse square or faster, other light more slowly.
constexpr double of_emitters = 2;

/// Points in each direction over which one averages.
constexpr int reach_points = 4;

/// A point has neighbours at so many times their spacing, whatever is near.
constexpr double least_steps = 2.5;

/// Of the points of a window, those at its ends count half: the window is then as wide as squares
/// of the sequence are (samples_of).
double ends(int step) { return std::abs(step) == reach_points ? .5 : 1; }

/// Surfaces whose normals differ by more than this cosine have light of their own.
constexpr double alike = .9;

/// So far from the other's plane, as a share of their distance, a point still is of its surface.
constexpr double flatness = .2;

/// Points that average over fewer steps than these get more rays, or many.
constexpr double steps_for_more = 7, steps_for_many = 3.5;

/// Relative errors of means from which on points get more rays, or many.
constexpr double noise_for_more = .05, noise_for_many = .1;

/// Of sums of the same light in another order.
constexpr double rounding = 1e-9;

/// The bits of x at even places.
std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 4) & 0x0f0fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
}

} // namespace

bool is_same_surface(const Vec3& a, const Vec3& normal_a, const Vec3& b, const Vec3& normal_b) {
    const Vec3 way = b - a;
    const double off = glm::dot(normal_a, way);
    return glm::dot(normal_a, normal_b) > alike &&
           off * off <= flatness * flatness * glm::dot(way, way);
}

PictureGather::PictureGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                             const CameraRays& camera, int width, int height,
                             const PictureGatherOptions& options, const Workers& workers)
    : options_(options), final_gather_(mesh, tracer, light), width_(width), height_(height),
      columns_((width + step - 1) / step), rows_((height + step - 1) / step) {
    find_points(mesh, camera, workers);
    gather([&](int, int) { return std::max(1u, options_.rays / 4); }, Shadows::traced, workers);
    ask_neighbours(workers);
    find_noise(workers);
    gather([&](int x, int y) { return more_rays(x, y); }, Shadows::left_out, workers);
    fit_light(1, workers);
    fit_light(reach_points, workers);
}

void PictureGather::give_up_if_asked() const {
    if (options_.give_up && options_.give_up())
        throw Interrupted();
}

/// Along a Z-curve, so that each aligned square of points has a net of the sequence (Ahmed and
/// Wonka 2020). Each block of 256 x 256 points has a sequence of its own for each count.
GatherSamples PictureGather::samples_of(int x, int y, unsigned count) const {
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    const std::uint32_t place = spread_bits(column & 255u) | spread_bits(row & 255u) << 1;
    return {hash_words({column >> 8, row >> 8, count}), place * count, count};
}

const PictureGather::Record* PictureGather::record(int x, int y) const {
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_)
        return nullptr;
    const Record& found =
        records_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(x)];
    return found.at.facet == none ? nullptr : &found;
}

void PictureGather::find_points(const Mesh& mesh, const CameraRays& camera,
                                const Workers& workers) {
    const std::array<Vec2, 1> offsets{pixel_centre};
    const VisibleFacets visible(mesh, camera,
                                {columns_, rows_, double(step) / width_, double(step) / height_},
                                offsets, workers.threads());
    const auto columns = static_cast<std::size_t>(columns_);
    records_.resize(columns * static_cast<std::size_t>(rows_));
    light_.resize(records_.size());
    slope_.resize(records_.size());
    for (Record& record : records_)
        record.at.facet = none;
    workers.for_chunks_with(
        static_cast<std::size_t>(visible.bands()), 1, [] { return VisibleFacets::Band(); },
        [&](VisibleFacets::Band& band, std::size_t b, std::size_t) {
            give_up_if_asked();
            visible.fill(static_cast<int>(b), band);
            const std::size_t first = b * VisibleFacets::rows_per_band;
            const std::size_t rows = std::min<std::size_t>(VisibleFacets::rows_per_band,
                                                           static_cast<std::size_t>(rows_) - first);
            for (std::size_t k = 0; k < rows * columns; ++k) {
                if (band.half[k] == nothing_visible)
                    continue;
                const Vec2 place(static_cast<double>(k % columns),
                                 static_cast<double>(first + k / columns));
                const Vec3 direction = visible.direction(place + pixel_centre);
                const Hit hit = visible.hit_at(band.half[k], direction);
                const std::uint32_t patch = mesh.patch_at(hit);
                records_[first * columns + k].at = {visible.eye() + hit.t * direction,
                                                    mesh.patches()[patch].normal, hit.facet};
            }
        });
}

/// By rays_at(x, y) more rays at each point.
template <class Rays>
void PictureGather::gather(const Rays& rays_at, Shadows shadows, const Workers& workers) {
    struct Own {
        std::vector<std::size_t> places;
        std::vector<SurfacePoint> points;
        std::vector<GatherSamples> samples;
    };
    const auto columns = static_cast<std::size_t>(columns_);
    workers.for_chunks_with(
        records_.size(), std::max<std::size_t>(16, 8192 / options_.rays), [] { return Own(); },
        [&](Own& own, std::size_t begin, std::size_t end) {
            give_up_if_asked();
            own = {};
            for (std::size_t k = begin; k < end; ++k) {
                if (records_[k].at.facet == none)
                    continue;
                const int x = static_cast<int>(k % columns), y = static_cast<int>(k / columns);
                const unsigned rays = rays_at(x, y);
                if (rays == 0)
                    continue;
                own.places.push_back(k);
                own.points.push_back(records_[k].at);
                own.samples.push_back(samples_of(x, y, rays));
            }
            const std::vector<IndirectLight> lights =
                final_gather_.indirect(own.points, own.samples);
            const std::vector<DirectLight> direct =
                final_gather_.direct(own.points, own.samples, shadows);
            for (std::size_t i = 0; i < lights.size(); ++i) {
                Record& record = records_[own.places[i]];
                record.rays += own.samples[i].count;
                const double share = double(own.samples[i].count) / record.rays;
                SlowLight& light = light_[own.places[i]];
                light.indirect = glm::mix(light.indirect, lights[i].irradiance, share);
                light.unshadowed = glm::mix(light.unshadowed, direct[i].unshadowed, share);
                record.nearness =
                    glm::mix(record.nearness,
                             std::max(lights[i].nearness, of_emitters * direct[i].nearness), share);
                if (shadows == Shadows::left_out)
                    continue;
                if (direct[i].arriving != Vec3(0.0))
                    record.shadow |= none_blocked;
                if (mean_of_channels(direct[i].arriving) <
                    (1 - rounding) * mean_of_channels(direct[i].unshadowed))
                    record.shadow |= all_blocked;
            }
        });
}

/// Where few points are near enough to average over, or where few rays find most of the light, as
/// that of a sky through a window.
unsigned PictureGather::more_rays(int x, int y) const {
    const Record& here = *record(x, y);
    const double width = spacing(x, y), reach = reach_share / here.nearness;
    if (reach < steps_for_many * width || width == 0 || here.noise > noise_for_many)
        return 4 * options_.rays;
    return reach < steps_for_more * width || here.noise > noise_for_more ? options_.rays : 0;
}

/// Of the mean around each point, by the spread of the points around as if they were independent.
void PictureGather::find_noise(const Workers& workers) {
    workers.for_chunks(static_cast<std::size_t>(rows_), 8, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < columns_; ++x)
                if (const Record* const here = record(x, y))
                    records_[place_of(*here)].noise = noise_around(*here, x, y);
    });
}

double PictureGather::noise_around(const Record& here, int x, int y) const {
    double n = 0, sum = 0, squares = 0;
    for (int dy = -reach_points; dy <= reach_points; ++dy)
        for (int dx = -reach_points; dx <= reach_points; ++dx)
            if (const Record* const there = record(x + dx, y + dy);
                there && here.is_of_surface(there->at)) {
                const double light = mean_of_channels(light_[place_of(*there)].indirect);
                ++n;
                sum += light;
                squares += light * light;
            }
    return sum > 0 ? std::sqrt(std::max(n * squares - sum * sum, 0.0) / n) / sum : 0;
}

/// A few rays estimate nearness badly, and may miss a shadow.
void PictureGather::ask_neighbours(const Workers& workers) {
    struct Asked {
        double nearness = 0;
        std::uint8_t shadow = 0;
    };
    std::vector<Asked> asked(records_.size());
    workers.for_chunks(static_cast<std::size_t>(rows_), 8, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < columns_; ++x) {
                const Record* const here = record(x, y);
                if (!here)
                    continue;
                double sum = 0, count = 0;
                Asked& of = asked[place_of(*here)];
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        if (const Record* const there = record(x + dx, y + dy);
                            there && here->is_of_surface(there->at)) {
                            sum += there->nearness;
                            ++count;
                            of.shadow |= there->shadow;
                        }
                of.nearness = sum / count;
            }
    });
    for (std::size_t k = 0; k < records_.size(); ++k) {
        records_[k].nearness = asked[k].nearness;
        records_[k].shadow = asked[k].shadow;
    }
}

/// From a point to the next ones on its surface; the larger of both directions.
double PictureGather::spacing(int x, int y) const {
    const Record* const here = record(x, y);
    double largest = 0;
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}})
        if (const Record* const there = record(x + dx, y + dy);
            there && here->is_of_surface(there->at))
            largest = std::max(largest, glm::distance(here->at.position, there->at.position));
    return largest;
}

void PictureGather::add(SlowLight& sum, const SlowLight& light, double weight) {
    sum.unshadowed += weight * light.unshadowed;
    sum.indirect += weight * light.indirect;
}

/// Of a point for the mean around another; 0 where it is too far away or of another surface.
/// `most`: inverse of a distance within which none is too far.
double PictureGather::weight_of(const Record& here, const Record* there, double most) {
    if (!there || !here.is_of_surface(there->at))
        return 0;
    const Vec3 way = there->at.position - here.at.position;
    const double share = std::min(std::max(here.nearness, there->nearness) / reach_share, most);
    return 1 - share * share * glm::dot(way, way);
}

/// A linear function of steps from a point, by weighted least squares.
struct PictureGather::Fit {
    double n = 1;
    Vec2 mean{0.0}, squares{.5}; ///< not 0, so that a few points do not say much of a slope
    double product = 0;
    SlowLight sum, by_x, by_y;

    void add(const Vec2& offset, const SlowLight& light, double weight) {
        n += weight;
        mean += weight * offset;
        squares += weight * offset * offset;
        product += weight * offset.x * offset.y;
        PictureGather::add(sum, light, weight);
        PictureGather::add(by_x, light, weight * offset.x);
        PictureGather::add(by_y, light, weight * offset.y);
    }
    /// From sums to the function: its slope, and its value at the point in `sum`.
    void solve(std::array<SlowLight, 2>& slope) {
        mean /= n;
        squares -= n * mean * mean;
        product -= n * mean.x * mean.y;
        PictureGather::add(by_x, sum, -mean.x);
        PictureGather::add(by_y, sum, -mean.y);
        const double determinant = squares.x * squares.y - product * product;
        slope = {};
        PictureGather::add(slope[0], by_x, squares.y / determinant);
        PictureGather::add(slope[0], by_y, -product / determinant);
        PictureGather::add(slope[1], by_y, squares.x / determinant);
        PictureGather::add(slope[1], by_x, -product / determinant);
        sum = {sum.unshadowed / n, sum.indirect / n};
        PictureGather::add(sum, slope[0], -mean.x);
        PictureGather::add(sum, slope[1], -mean.y);
        sum = {glm::max(sum.unshadowed, 0.0), glm::max(sum.indirect, 0.0)};
    }
};

/// To the points around, so that light which changes evenly stays as it is up to the edge of a
/// surface (local linear regression: Fan 1992). They are `stride` apart: what was smoothed with
/// stride 1 has little detail between such points (the algorithme a trous: Dammertz et al. 2010).
void PictureGather::fit_light(int stride, const Workers& workers) {
    std::vector<SlowLight> fitted(records_.size());
    workers.for_chunks(static_cast<std::size_t>(rows_), 8, [&](std::size_t begin, std::size_t end) {
        give_up_if_asked();
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < columns_; ++x) {
                const Record* const here = record(x, y);
                if (!here)
                    continue;
                const double most = 1 / (least_steps * spacing(x, y));
                Fit fit;
                fit.sum = light_[place_of(*here)];
                for (int dy = -reach_points; dy <= reach_points; ++dy)
                    for (int dx = -reach_points; dx <= reach_points; ++dx) {
                        const Record* const there = record(x + stride * dx, y + stride * dy);
                        const double weight = ends(dx) * ends(dy) * weight_of(*here, there, most);
                        if (weight > 0 && there != here)
                            fit.add({dx, dy}, light_[place_of(*there)], weight);
                    }
                std::array<SlowLight, 2> slope;
                fit.solve(slope);
                fitted[place_of(*here)] = fit.sum;
                constexpr double enough = 10; // points that are wide apart know a slope better
                if (stride == 1 || fit.n > enough)
                    for (std::size_t k = 0; k < slope.size(); ++k)
                        slope_[place_of(*here)][k] = {slope[k].unshadowed / double(stride),
                                                      slope[k].indirect / double(stride)};
            }
    });
    light_ = std::move(fitted);
}

/// From the four points around, as far as they are of the same surface; where none is, as on narrow
/// strips, from the twelve around these.
std::optional<PictureGather::Around> PictureGather::interpolate(const Place& place) const {
    const double x = place.pixel.x / step - pixel_centre.x,
                 y = place.pixel.y / step - pixel_centre.y;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    constexpr double least = 1e-3; // on an edge of the square of points both sides count
    for (int ring = 0; ring <= 1; ++ring) {
        Around around;
        SlowLight& sum = around.light;
        double weights = 0;
        for (int dy = -ring; dy <= 1 + ring; ++dy)
            for (int dx = -ring; dx <= 1 + ring; ++dx) {
                const Record* const there = record(left + dx, top + dy);
                if (!there || !there->is_of_surface(place.at))
                    continue;
                const Vec3 way = there->at.position - place.at.position;
                const double share = there->nearness / reach_share;
                const double across = std::max(1 - std::abs(x - left - dx), 0.0),
                             down = std::max(1 - std::abs(y - top - dy), 0.0);
                const double weight =
                    (least + across * down) / (1 + share * share * glm::dot(way, way));
                const std::size_t of = place_of(*there);
                add(sum, light_[of], weight);
                add(sum, slope_[of][0], weight * (x - left - dx));
                add(sum, slope_[of][1], weight * (y - top - dy));
                weights += weight;
                around.shadow |= there->shadow;
            }
        if (!(weights > 0))
            continue;
        sum.unshadowed = glm::max(sum.unshadowed / weights, 0.0);
        sum.indirect = glm::max(sum.indirect / weights, 0.0);
        return around;
    }
    return {};
}

/// Shadow rays are traced where some were blocked around, and some were not; all rays where no
/// point is around.
std::vector<PictureGather::Light> PictureGather::irradiance(std::span<const Place> places) const {
    /// Which of the places, and with which samples.
    struct Some {
        std::vector<std::size_t> which;
        std::vector<SurfacePoint> points;
        std::vector<GatherSamples> samples;

        void add(std::size_t place, const SurfacePoint& point, const GatherSamples& of) {
            which.push_back(place);
            points.push_back(point);
            samples.push_back(of);
        }
    };
    Some alone, in_penumbra;
    std::vector<Light> found(places.size());
    const unsigned each = std::max(1u, options_.rays / (2 * options_.samples)),
                   of_pixel = each * options_.samples;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& place = places[k];
        const int x = static_cast<int>(place.pixel.x), y = static_cast<int>(place.pixel.y);
        auto& [direct, slow] = found[k];
        const std::optional<Around> around = interpolate(place);
        if (around)
            slow = around->light;
        else
            alone.add(k, place.at, samples_of(x, y, 4 * options_.rays));
        if (around && (around->shadow == none_blocked || around->shadow == all_blocked)) {
            direct.unshadowed = slow.unshadowed;
            direct.arriving = around->shadow == none_blocked ? slow.unshadowed : Vec3(0.0);
            continue;
        }
        GatherSamples samples = samples_of(x, y, of_pixel);
        samples.first += each * place.sample;
        samples.count = each * place.count;
        in_penumbra.add(k, place.at, samples);
    }
    const std::vector<DirectLight> direct =
        final_gather_.direct(in_penumbra.points, in_penumbra.samples, Shadows::traced);
    for (std::size_t i = 0; i < direct.size(); ++i)
        found[in_penumbra.which[i]].direct = direct[i];
    const std::vector<IndirectLight> lights = final_gather_.indirect(alone.points, alone.samples);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light& light = found[alone.which[i]];
        light.slow = {light.direct.unshadowed, lights[i].irradiance};
    }
    return found;
}

} // namespace hemilux
