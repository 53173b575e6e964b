#include "io/pictures/picture_gather.h"

#include "io/files/error.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
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
    gather(workers);
    smooth_nearness(workers);
    smooth_light(1, workers);
    smooth_light(reach_points, workers);
}

void PictureGather::give_up_if_asked() const {
    if (options_.give_up && options_.give_up())
        throw Interrupted();
}

/// Along a Z-curve, so that each aligned square of points has a net of the sequence (Ahmed and
/// Wonka 2020). Each block of 256 x 256 points has a sequence of its own.
GatherSamples PictureGather::samples_of(int x, int y, unsigned count) const {
    const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
    const std::uint32_t place = spread_bits(column & 255u) | spread_bits(row & 255u) << 1;
    return {hash_words({column >> 8, row >> 8}), place * count, count};
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

void PictureGather::gather(const Workers& workers) {
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
                own.places.push_back(k);
                own.points.push_back(records_[k].at);
                own.samples.push_back(samples_of(static_cast<int>(k % columns),
                                                 static_cast<int>(k / columns), options_.rays));
            }
            const std::vector<IndirectLight> lights =
                final_gather_.indirect(own.points, own.samples);
            const std::vector<DirectLight> direct =
                final_gather_.direct(own.points, own.samples, Shadows::left_out);
            for (std::size_t i = 0; i < lights.size(); ++i) {
                records_[own.places[i]].light.indirect = lights[i].irradiance;
                records_[own.places[i]].light.unshadowed = direct[i].unshadowed;
                records_[own.places[i]].nearness =
                    std::max(lights[i].nearness, of_emitters * direct[i].nearness);
            }
        });
}

/// A few rays estimate it badly.
void PictureGather::smooth_nearness(const Workers& workers) {
    std::vector<double> smoothed(records_.size());
    workers.for_chunks(static_cast<std::size_t>(rows_), 8, [&](std::size_t begin, std::size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < columns_; ++x) {
                const Record* const here = record(x, y);
                if (!here)
                    continue;
                double sum = 0, count = 0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        if (const Record* const there = record(x + dx, y + dy);
                            there && here->is_of_surface(there->at)) {
                            sum += there->nearness;
                            ++count;
                        }
                smoothed[static_cast<std::size_t>(here - records_.data())] = sum / count;
            }
    });
    for (std::size_t k = 0; k < records_.size(); ++k)
        records_[k].nearness = smoothed[k];
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

/// Over points in opposite pairs, so that light which changes evenly stays as it is up to the edge
/// of a surface. They are `stride` apart: what was smoothed with stride 1 has little detail between
/// such points (the algorithme a trous: Dammertz et al. 2010).
void PictureGather::smooth_light(int stride, const Workers& workers) {
    std::vector<SlowLight> smoothed(records_.size());
    workers.for_chunks(static_cast<std::size_t>(rows_), 8, [&](std::size_t begin, std::size_t end) {
        give_up_if_asked();
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
            for (int x = 0; x < columns_; ++x) {
                const Record* const here = record(x, y);
                if (!here)
                    continue;
                const double most = 1 / (least_steps * spacing(x, y));
                SlowLight sum = here->light;
                double weights = 1;
                for (int dy = 0; dy <= reach_points; ++dy)
                    for (int dx = dy > 0 ? -reach_points : 1; dx <= reach_points; ++dx) {
                        const Record* const there = record(x + stride * dx, y + stride * dy);
                        const Record* const opposite = record(x - stride * dx, y - stride * dy);
                        const double weight = ends(dx) * ends(dy) *
                                              std::min(weight_of(*here, there, most),
                                                       weight_of(*here, opposite, most));
                        if (!(weight > 0))
                            continue;
                        add(sum, there->light, weight);
                        add(sum, opposite->light, weight);
                        weights += 2 * weight;
                    }
                smoothed[static_cast<std::size_t>(here - records_.data())] = {
                    sum.unshadowed / weights, sum.indirect / weights};
            }
    });
    for (std::size_t k = 0; k < records_.size(); ++k)
        records_[k].light = smoothed[k];
}

/// From the four points around, as far as they are of the same surface. False where none is.
bool PictureGather::interpolate(const Place& place, SlowLight& light) const {
    const double x = place.pixel.x / step - pixel_centre.x,
                 y = place.pixel.y / step - pixel_centre.y;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    constexpr double least = 1e-3; // on an edge of the square of points both sides count
    SlowLight sum;
    double weights = 0;
    for (int dy = 0; dy <= 1; ++dy)
        for (int dx = 0; dx <= 1; ++dx) {
            const Record* const there = record(left + dx, top + dy);
            if (!there || !there->is_of_surface(place.at))
                continue;
            const Vec3 way = there->at.position - place.at.position;
            const double share = there->nearness / reach_share;
            const double weight =
                (least + (1 - std::abs(x - left - dx)) * (1 - std::abs(y - top - dy))) /
                (1 + share * share * glm::dot(way, way));
            add(sum, there->light, weight);
            weights += weight;
        }
    if (!(weights > 0))
        return false;
    light.unshadowed = sum.unshadowed / weights;
    light.indirect = sum.indirect / weights;
    return true;
}

std::vector<PictureGather::Light> PictureGather::irradiance(std::span<const Place> places) const {
    std::vector<SurfacePoint> points, alone;
    std::vector<GatherSamples> samples, samples_alone;
    std::vector<std::size_t> places_alone;
    std::vector<Light> found(places.size());
    const unsigned each = options_.shadow_rays_per_sample, of_pixel = each * options_.samples;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Place& place = places[k];
        const int x = static_cast<int>(place.pixel.x), y = static_cast<int>(place.pixel.y);
        points.push_back(place.at);
        samples.push_back(samples_of(x, y, of_pixel));
        samples.back().first += each * place.sample;
        samples.back().count = each * place.count;
        if (interpolate(place, found[k].slow))
            continue;
        places_alone.push_back(k);
        alone.push_back(place.at);
        samples_alone.push_back(samples_of(x, y, options_.rays));
    }
    const std::vector<DirectLight> direct = final_gather_.direct(points, samples, Shadows::traced);
    const std::vector<IndirectLight> lights = final_gather_.indirect(alone, samples_alone);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        found[places_alone[i]].slow.indirect = lights[i].irradiance;
        found[places_alone[i]].slow.unshadowed = direct[places_alone[i]].unshadowed;
    }
    for (std::size_t k = 0; k < found.size(); ++k)
        found[k].direct = direct[k];
    return found;
}

} // namespace hemilux
