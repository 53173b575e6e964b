#include "radiosity/engine/emitters/direct_light.h"

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
#include <utility>

namespace hemilux {

/// Samples whose rays are not traced yet.
struct DirectLight::RayBatch {
    struct Sample {
        std::uint32_t patch, estimate;
        Vec3 light; ///< if the ray arrives
    };
    ShadowRays<Sample> rays;
    std::uint64_t traced = 0;
    EmitterChoice::Cut cut; ///< of the present patch
};

DirectLight::DirectLight(const Mesh& mesh, const Tracer& tracer, const Needs& needs,
                         std::span<const std::uint32_t> emitters, std::vector<std::uint64_t> seeds,
                         const Ranks& ranks)
    : mesh_(mesh), tracer_(tracer), needs_(needs), own_(ranks, mesh.patches().size()),
      emitters_(mesh, emitters), seeds_(std::move(seeds)),
      sum_(mesh.patches().size() * seeds_.size(), Vec3(0.0)), samples_(mesh.patches().size()),
      hits_(mesh.patches().size()), unblocked_(mesh.patches().size()),
      of_points_(mesh, tracer, seeds_, ranks) {}

Vec3 DirectLight::of_surfaces(std::uint32_t patch) const {
    Vec3 sum(0.0);
    for (std::size_t s = 0; s < seeds_.size(); ++s)
        sum += of_surfaces(patch, s);
    return sum / static_cast<double>(seeds_.size());
}

std::uint64_t DirectLight::sample_up_to(std::span<const std::uint32_t> samples,
                                        const Workers& workers, Monitor& monitor) {
    const std::uint64_t to_points = of_points_.sample_up_to(samples, workers, monitor);
    if (emitters_.empty())
        return to_points;
    const std::uint64_t traced = sample_patches<RayBatch>(
        own_, workers, monitor,
        [&](std::uint32_t patch, RayBatch& batch) {
            if (samples[patch] > samples_[patch])
                sample(patch, samples[patch], batch);
        },
        [&](RayBatch& batch) { send(batch); });
    own_.gather(sum_, seeds_.size());
    own_.gather(samples_);
    own_.gather(hits_);
    own_.gather(unblocked_);
    return to_points + traced;
}

void DirectLight::sample(std::uint32_t patch, std::uint32_t end, RayBatch& batch) {
    const std::uint32_t begin = std::exchange(samples_[patch], end);
    EmitterChoice::Cut& cut = batch.cut;
    emitters_.choice().weigh(patch, cut);
    if (cut.dark())
        return;
    if (!cut.pays()) {
        samples_[patch] = 0;
        return;
    }
    const Patch& receiver = mesh_.patches()[patch];
    const PolygonSampler places(receiver.shape);
    EmitterChoice::Choices choices;
    for (std::uint32_t s = 0; s < seeds_.size(); ++s) {
        SobolBlocks<5> points(hash_words({seeds_[s], patch}));
        for (std::uint32_t k = begin; k < end; ++k) {
            const std::size_t in_block = k % samples_per_block;
            if (k == begin || in_block == 0) {
                points.move_to(k);
                emitters_.choice().choose(cut, points.coordinate(4), choices);
            }
            const std::array<double, 5> u = points.point(k);
            const SurfacePoint at{places.sample({u[0], u[1]}), receiver.normal, receiver.facet};
            if (const auto aimed = emitters_.aim(choices[in_block], at, {u[2], u[3]}))
                batch.rays.add(aimed->ray, aimed->target,
                               {patch, s, aimed->factor * aimed->emission});
            if (batch.rays.size() == rays_at_a_time)
                send(batch);
        }
    }
}

void DirectLight::send(RayBatch& batch) {
    const auto use = [&](const RayBatch::Sample& sample, double share) {
        const auto& [patch, estimate, light] = sample;
        unblocked_[patch] += mean_of_channels(light);
        if (share > 0) {
            sum_[patch * seeds_.size() + estimate] += share * light;
            ++hits_[patch];
        }
    };
    if (needs_.visibility)
        batch.traced += batch.rays.trace(tracer_, use);
    else
        batch.rays.take_all(use);
}

void DirectLight::save(StateWriter& state) const {
    state.add(std::span<const Vec3>(sum_));
    state.add(std::span<const std::uint32_t>(samples_));
    state.add(std::span<const std::uint32_t>(hits_));
    state.add(std::span<const double>(unblocked_));
    of_points_.save(state);
}

void DirectLight::load(StateReader& state) {
    state.get(std::span(sum_), bounds::non_negative);
    // A patch for which shadow rays no longer pay keeps its sums, but has no samples.
    constexpr double max_forgotten = 1u << 20;
    const auto check_mean = [](double sum, double samples) {
        if (sum > largest_radiosity * (samples > 0 ? samples : max_forgotten))
            throw StateError("shadow rays brought more light than there may be");
    };
    state.get(std::span(samples_));
    state.get(std::span(hits_));
    for (std::size_t i = 0; i < hits_.size(); ++i)
        if (samples_[i] > 0 && hits_[i] > std::uint64_t{samples_[i]} * seeds_.size())
            throw StateError("more shadow rays arrived than were traced");
    for (std::size_t k = 0; k < sum_.size(); ++k)
        check_mean(std::max({sum_[k].x, sum_[k].y, sum_[k].z}), samples_[k / seeds_.size()]);
    state.get(std::span(unblocked_), bounds::non_negative);
    for (std::size_t i = 0; i < unblocked_.size(); ++i)
        check_mean(unblocked_[i], double(samples_[i]) * double(seeds_.size()));
    of_points_.load(state);
}

} // namespace hemilux
