#include "radiosity/light/final_gather/light_at_points.h"

#include "parallel/workers.h"
#include "radiosity/light/cached_light/local_error.h"
#include "radiosity/light/final_gather/final_gather.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hemilux {
namespace {

/// The number of gathers of a point, independent of each other, whose spread is the error of their
/// mean.
constexpr unsigned gathers = 8;

constexpr unsigned rays_of_round = FinalGather::usual_random_rays;

/// The number of rays traced before it is asked again whether to end: a fraction of a second.
constexpr std::size_t rays_per_block = 1 << 18;

/// The mean of the gathers of a point, and its variance.
struct Gathered {
    Vec3 irradiance{0.0}, variance{0.0};
};

Gathered mean_of(std::span<const Vec3> estimates) {
    Gathered mean;
    for (const Vec3& estimate : estimates)
        mean.irradiance += estimate / double(gathers);
    Vec3 squares(0.0);
    for (const Vec3& estimate : estimates)
        squares += (estimate - mean.irradiance) * (estimate - mean.irradiance);
    mean.variance = squares / double(gathers * (gathers - 1));
    return mean;
}

/// What the work has to ask before each block of points.
class Limits {
  public:
    explicit Limits(const PointLightOptions& options) : options_(options) {}

    /// Returns the reason to begin no more; `right` where there is none.
    [[nodiscard]] PointsEnd reached(std::uint64_t rays) const {
        if (rays >= options_.max_all_rays)
            return PointsEnd::rays;
        if (rays == 0) // of the first block, whose light is given out in any case
            return PointsEnd::right;
        if (options_.give_up && options_.give_up())
            return PointsEnd::gave_up;
        return options_.seconds && elapsed() > *options_.seconds ? PointsEnd::time
                                                                 : PointsEnd::right;
    }
    /// Notes the share of the rays that is done.
    void tell(double share) const {
        if (options_.share)
            *options_.share = share;
    }

  private:
    [[nodiscard]] double elapsed() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

    const PointLightOptions& options_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Gathers at the sensors in order with so many rounds of rays in each of the gathers, until a
/// limit is reached, which `end` then names. The rays of a point before were `before` rounds.
std::vector<Gathered> gather_at(std::span<const Sensor> sensors, FinalGather& gather,
                                unsigned before, unsigned rounds, std::uint64_t seed,
                                const Limits& limits, const Workers& workers, PointsEnd& end) {
    const std::size_t rays_of_point = std::size_t{gathers} * rays_of_round * rounds;
    const std::size_t block = std::max<std::size_t>(1, rays_per_block / rays_of_point);
    const StopFlag never;
    gather.set_rounds(rounds);
    std::vector<Gathered> found;
    found.reserve(sensors.size());
    for (std::size_t begin = 0; begin < sensors.size(); begin += block) {
        end = limits.reached(gather.rays());
        if (end != PointsEnd::right)
            break;
        limits.tell((before + rounds * double(begin) / double(sensors.size())) / (before + rounds));
        std::vector<SurfacePoint> at;
        std::vector<std::uint64_t> streams;
        for (const Sensor& sensor :
             sensors.subspan(begin, std::min(block, sensors.size() - begin))) {
            at.push_back(sensor.at);
            streams.push_back(hash_words({seed, begin + at.size()}));
        }
        const std::vector<Vec3> estimates = gather.irradiance(at, streams, gathers, workers, never);
        for (std::size_t k = 0; k < at.size(); ++k)
            found.push_back(mean_of(std::span(estimates).subspan(k * gathers, gathers)));
    }
    return found;
}

/// Returns the noise over all points relative to their irradiance; 0 without light.
double noise_of(std::span<const Gathered> found) {
    double squares = 0, noise = 0;
    for (const Gathered& point : found) {
        noise += point.variance.x + point.variance.y + point.variance.z;
        squares += glm::dot(point.irradiance, point.irradiance);
    }
    return squares > 0 ? std::sqrt(noise / squares) : 0;
}

} // namespace

Sensor sensor_at(const Mesh& mesh, const Tracer& tracer, const Vec3& position, const Vec3& normal) {
    constexpr double near = 2e-6;             // the local frame is 2 wide
    constexpr double same_direction = .99985; // cosine of a degree
    Ray down{position + near * normal, -normal};
    down.t_max = 2 * near;
    const auto hit = tracer.closest(down);
    const std::uint32_t patch = hit ? mesh.patch_at(*hit) : none;
    if (patch == none || glm::dot(mesh.patches()[patch].normal, normal) < same_direction)
        return {{position, normal, none}, none};
    return {{down.origin + hit->t * down.direction, normal, hit->facet}, patch};
}

/// The first rays say how many are needed; these are traced besides, and the mean goes by the
/// number of rays. Noise falls at least as the root of their number.
LightAtPoints light_at(std::span<const Sensor> sensors, const Mesh& mesh, const Tracer& tracer,
                       const SurfaceLight& light, const PointLightOptions& options,
                       const Workers& workers) {
    constexpr unsigned first_rounds = 1, max_growth = 16;
    const auto rounds_of = [](double rays) {
        return std::max(1u, static_cast<unsigned>(std::ceil(rays / (gathers * rays_of_round))));
    };
    FinalGather gather(mesh, tracer, light);
    const Limits limits(options);
    LightAtPoints all;
    std::vector<Gathered> found;
    unsigned next = options.rays > 0 ? rounds_of(options.rays) : first_rounds, rounds = 0;
    for (std::uint64_t pass = 0; next > 0; ++pass) {
        const std::vector<Gathered> more =
            gather_at(sensors, gather, rounds, next, hash_words({options.seed, pass}), limits,
                      workers, all.end);
        const double share = double(next) / double(rounds + next);
        if (pass == 0)
            found.resize(more.size());
        for (std::size_t k = 0; k < more.size(); ++k)
            found[k] = {glm::mix(found[k].irradiance, more[k].irradiance, share),
                        (1 - share) * (1 - share) * found[k].variance +
                            share * share * more[k].variance};
        rounds += next;
        next = 0;
        if (all.end != PointsEnd::right)
            break;
        const double excess = noise_of(found) / options.noise;
        const unsigned most = std::max(1u, options.max_rays / (gathers * rays_of_round));
        if (options.rays == 0 && excess > 1 && rounds < most)
            next = static_cast<unsigned>(
                std::clamp(std::ceil((excess * excess - 1) * rounds), 1.0,
                           double(std::min(max_growth * rounds, most - rounds))));
    }
    all.noise = noise_of(found);
    all.rays = gather.rays();
    all.lights.reserve(found.size());
    double sum = 0, squares = 0;
    LocalErrors places;
    for (const Gathered& point : found) {
        const Vec3 read(options.read_error);
        all.lights.push_back({point.irradiance, glm::sqrt(point.variance + read * read)});
        const double variance = point.variance.x + point.variance.y + point.variance.z;
        places.add(variance, glm::dot(point.irradiance, point.irradiance));
        sum += variance;
        squares += variance * variance;
    }
    // The squared error is a sum over so many points as have about the same noise. It scatters
    // itself, and so does the variance that a few gathers give.
    constexpr double sigmas_of_most = 1.96; // 95 of 100 normal errors are smaller
    all.noise_local = sigmas_of_most * places.within();
    constexpr double freedom = gathers - 1;
    if (sum > 0)
        all.noise_uncertainty =
            all.noise * std::sqrt(.5 * squares / (sum * sum) * (1 + 1 / freedom));
    return all;
}

} // namespace hemilux
