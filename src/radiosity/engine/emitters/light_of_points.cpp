#include "radiosity/engine/emitters/light_of_points.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/engine/emitters/sample_patches.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// Directions uniform in solid angle have lost too many digits below it [sr].
constexpr double min_solid_angle = 1e-4;

/// Returns the samples of a patch in each estimate. One that is to have none, as it is black, has a
/// few all the same: what it absorbs is a part of the balance of energy.
std::uint32_t planned(std::uint32_t samples) {
    constexpr std::uint32_t of_black = 4;
    return samples > 0 ? samples : of_black;
}

/// A light that shines at the front of a patch. `sum` is what all lights up to it would send there.
struct Shining {
    std::uint32_t light;
    SeenPolygon seen;
    double weight, sum;
};

/// Returns an upper bound of the intensity towards a patch, relative to that on the axis.
double max_intensity_towards(const PointEmitter& emitter, const Patch& patch) {
    const Vec3 way = patch.centre - emitter.position;
    const double distance = glm::length(way), sine = radius_of(patch) / distance;
    if (!(sine < 1)) // the light is within the ball around the patch
        return max_relative_intensity(emitter);
    return max_relative_intensity(emitter, way / distance, std::sqrt(1 - sine * sine), sine);
}

/// A ray from a point of a patch to a light, and the light that arrives there [W/m2].
struct Aimed {
    Ray ray;
    Vec3 irradiance;
};

/// Draws a point of the patch, uniform in solid angle. Empty where that is edge-on.
std::optional<Aimed> aim_by_angle(const PointEmitter& emitter, const SeenPolygon& seen,
                                  const Patch& patch, Vec2 u) {
    const Vec3 direction = seen.sample(u);
    const double along = glm::dot(direction, patch.normal);
    const double way = glm::dot(patch.centre - emitter.position, patch.normal) / along;
    if (!(along < 0) || !(way >= 0) || !std::isfinite(way))
        return std::nullopt;
    const double intensity = relative_intensity(emitter, direction);
    return Aimed{{.origin = emitter.position + way * direction,
                  .direction = -direction,
                  .t_max = std::max(way - near_light, 0.0),
                  .from = patch.facet},
                 (intensity * seen.solid_angle() / patch.area) * emitter.intensity};
}

} // namespace

/// Samples whose rays are not traced yet, and the lights of the present patch.
struct LightOfPoints::Work {
    struct Sample {
        std::uint32_t patch, estimate;
        Vec3 light; ///< if the ray arrives
    };
    ShadowRays<Sample> rays;
    std::uint64_t traced = 0;
    std::vector<Shining> shining;
};

LightOfPoints::LightOfPoints(const Mesh& mesh, const Tracer& tracer,
                             std::vector<std::uint64_t> seeds, const Ranks& ranks)
    : mesh_(mesh), tracer_(tracer), own_(ranks, mesh.patches().size()), emitters_(mesh),
      seeds_(std::move(seeds)) {
    if (empty())
        return;
    const std::size_t patches = mesh.patches().size();
    sum_.assign(patches * seeds_.size(), Vec3(0.0));
    samples_.resize(patches);
    hits_.resize(patches);
    unblocked_.resize(patches);
}

Vec3 LightOfPoints::irradiance(std::uint32_t patch) const {
    Vec3 sum(0.0);
    for (std::size_t s = 0; s < seeds_.size(); ++s)
        sum += irradiance(patch, s);
    return sum / static_cast<double>(seeds_.size());
}

std::uint64_t LightOfPoints::bytes() const {
    return sum_.size() * sizeof(Vec3) +
           samples_.size() * (2 * sizeof(std::uint32_t) + sizeof(double));
}

std::uint64_t LightOfPoints::sample_up_to(std::span<const std::uint32_t> samples,
                                          const Workers& workers, Monitor& monitor) {
    if (empty())
        return 0;
    const std::uint64_t traced = sample_patches<Work>(
        own_, workers, monitor,
        [&](std::uint32_t patch, Work& work) {
            if (planned(samples[patch]) > samples_[patch])
                sample(patch, planned(samples[patch]), work);
        },
        [&](Work& work) { send(work); });
    own_.gather(sum_, seeds_.size());
    own_.gather(samples_);
    own_.gather(hits_);
    own_.gather(unblocked_);
    return traced;
}

void LightOfPoints::look_from_lights(std::uint32_t patch, Work& work) const {
    const Patch& receiver = mesh_.patches()[patch];
    work.shining.clear();
    double sum = 0;
    for (std::uint32_t k = 0; k < emitters_.count(); ++k) {
        const PointEmitter& emitter = emitters_[k];
        if (!(glm::dot(emitter.position - receiver.centre, receiver.normal) > 0))
            continue;
        const double intensity =
            emitters_.balanced(emitter.intensity) * max_intensity_towards(emitter, receiver);
        if (!(intensity > 0))
            continue;
        const SeenPolygon seen(emitter.position, receiver.shape);
        const double weight = intensity * seen.solid_angle();
        if (weight > 0)
            work.shining.push_back({k, seen, weight, sum += weight});
    }
}

void LightOfPoints::sample(std::uint32_t patch, std::uint32_t end, Work& work) {
    const std::uint32_t begin = std::exchange(samples_[patch], end);
    const Patch& receiver = mesh_.patches()[patch];
    look_from_lights(patch, work);
    if (work.shining.empty()) { // no more are planned then
        samples_[patch] = 0;
        return;
    }
    const double sum = work.shining.back().sum;
    const PolygonSampler places(receiver.shape);
    for (std::uint32_t s = 0; s < seeds_.size(); ++s) {
        SobolBlocks<5> numbers(hash_words({seeds_[s], patch, 2}));
        for (std::uint32_t k = begin; k < end; ++k) {
            const std::array<double, 5> u = numbers.at(k);
            const auto drawn =
                std::min(std::ranges::upper_bound(work.shining, u[4] * sum, {}, &Shining::sum),
                         work.shining.end() - 1);
            const double chance = drawn->weight / sum;
            std::optional<Aimed> aimed;
            if (drawn->seen.solid_angle() >= min_solid_angle)
                aimed = aim_by_angle(emitters_[drawn->light], drawn->seen, receiver, {u[0], u[1]});
            if (!aimed)
                if (const auto at = emitters_.at(drawn->light, {places.sample({u[0], u[1]}),
                                                                receiver.normal, receiver.facet}))
                    aimed = {at->ray, at->irradiance};
            if (aimed && aimed->irradiance != Vec3(0.0))
                work.rays.add(aimed->ray, none, {patch, s, aimed->irradiance / chance});
            if (work.rays.size() == rays_at_a_time)
                send(work);
        }
    }
}

void LightOfPoints::send(Work& work) {
    work.traced += work.rays.trace(tracer_, [&](const Work::Sample& sample, double share) {
        const auto& [patch, estimate, light] = sample;
        unblocked_[patch] += mean_of_channels(light);
        if (share > 0) {
            sum_[patch * seeds_.size() + estimate] += share * light;
            ++hits_[patch];
        }
    });
}

void LightOfPoints::save(StateWriter& state) const {
    if (empty())
        return;
    state.add(std::span<const Vec3>(sum_));
    state.add(std::span<const std::uint32_t>(samples_));
    state.add(std::span<const std::uint32_t>(hits_));
    state.add(std::span<const double>(unblocked_));
}

void LightOfPoints::load(StateReader& state) {
    if (empty())
        return;
    state.get(std::span(sum_), bounds::non_negative);
    state.get(std::span(samples_));
    state.get(std::span(hits_));
    state.get(std::span(unblocked_), bounds::non_negative);
    for (std::uint32_t i = 0; i < hits_.size(); ++i) {
        if (hits_[i] > std::uint64_t{samples_[i]} * seeds_.size())
            throw StateError("more shadow rays arrived than were traced");
        const Vec3 mean = irradiance(i);
        if (std::max({mean.x, mean.y, mean.z, unblocked(i)}) > largest_radiosity)
            throw StateError("shadow rays brought more light than there may be");
    }
}

} // namespace hemilux
