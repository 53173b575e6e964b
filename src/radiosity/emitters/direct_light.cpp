#include "radiosity/emitters/direct_light.h"

#include "radiosity/emitters/small_emitters.h"
#include "radiosity/form_factors/pair_factor.h"
#include "radiosity/form_factors/point_to_patch.h"
#include "radiosity/rays/receivers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/saving/state.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solution/solve_error.h"
#include "radiosity/solving/solver.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t patches_per_chunk = 8;

} // namespace

/// Samples whose rays are not traced yet, the first `size` of each array.
struct DirectLight::RayBatch {
    struct Sample {
        std::uint32_t patch, estimate;
        Vec3 light; ///< if the ray arrives
    };
    std::size_t size = 0;
    std::vector<Sample> samples = std::vector<Sample>(rays_at_a_time);
    std::vector<Ray> rays = std::vector<Ray>(rays_at_a_time);
    std::vector<std::uint32_t> targets = std::vector<std::uint32_t>(rays_at_a_time); ///< facets
    std::vector<std::uint8_t> blocked = std::vector<std::uint8_t>(rays_at_a_time);
    std::uint64_t traced = 0;
    EmitterChoice::Cut cut; ///< of the present patch

    [[nodiscard]] bool full() const { return size == rays_at_a_time; }
};

DirectLight::Shape::Shape(const Patch& of) : patch(&of), points(of.shape) {}

DirectLight::DirectLight(const Mesh& mesh, const Tracer& tracer, const Needs& needs,
                         std::span<const std::uint32_t> emitters, std::vector<std::uint64_t> seeds,
                         const Ranks& ranks)
    : mesh_(mesh), tracer_(tracer), needs_(needs), own_(ranks, mesh.patches().size()),
      emitters_(whole_sides(mesh, one_of_each_side(mesh, emitters))), choice_(mesh, emitters_),
      seeds_(std::move(seeds)), sum_(mesh.patches().size() * seeds_.size(), Vec3(0.0)),
      samples_(mesh.patches().size()), hits_(mesh.patches().size()),
      unblocked_(mesh.patches().size()) {
    for (const Patch& emitter : emitters_)
        emitter_shapes_.push_back(
            {Shape(emitter), mesh.material(emitter).emission, near_radii * radius_of(emitter)});
}

Vec3 DirectLight::irradiance(std::uint32_t patch) const {
    Vec3 sum(0.0);
    for (std::size_t s = 0; s < seeds_.size(); ++s)
        sum += irradiance(patch, s);
    return sum / static_cast<double>(seeds_.size());
}

std::uint64_t DirectLight::sample_up_to(std::span<const std::uint32_t> samples,
                                        const Workers& workers, Monitor& monitor) {
    if (emitters_.empty())
        return 0;
    std::atomic<std::uint64_t> traced{0};
    std::optional<StopFlag::OfThisRank> on_this_rank(monitor.interrupted);
    workers.for_chunks_with(
        own_.count(), patches_per_chunk, [] { return RayBatch(); },
        [&](RayBatch& batch, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end && !monitor.interrupted; ++k)
                if (const std::size_t i = own_.item(k); samples[i] > samples_[i])
                    sample(static_cast<std::uint32_t>(i), samples[i], batch);
            send(batch);
            traced += batch.traced;
            monitor.rays += std::exchange(batch.traced, 0);
        });
    on_this_rank.reset();
    monitor.interrupted.agree();
    own_.ranks().add_work(traced, 0);
    gather();
    return own_.ranks().sum(traced);
}

void DirectLight::gather() {
    OwnBlocks(own_.ranks(), sum_.size(), own_.block() * seeds_.size()).gather(sum_);
    own_.gather(samples_);
    own_.gather(hits_);
    own_.gather(unblocked_);
}

void DirectLight::sample(std::uint32_t patch, std::uint32_t end, RayBatch& batch) {
    const std::uint32_t begin = std::exchange(samples_[patch], end);
    EmitterChoice::Cut& cut = batch.cut;
    choice_.weigh(patch, cut);
    if (cut.dark())
        return;
    if (!cut.pays()) {
        samples_[patch] = 0;
        return;
    }
    const Shape receiver(mesh_.patches()[patch]);
    EmitterChoice::Choices choices;
    for (std::uint32_t s = 0; s < seeds_.size(); ++s) {
        SobolBlocks<5> points(hash_words({seeds_[s], patch}));
        for (std::uint32_t k = begin; k < end; ++k) {
            const std::size_t in_block = k % samples_per_block;
            if (k == begin || in_block == 0) {
                points.move_to(k);
                choice_.choose(cut, points.coordinate(4), choices);
            }
            look(patch, s, receiver, points.point(k), choices[in_block], batch);
            if (batch.full())
                send(batch);
        }
    }
}

void DirectLight::look(std::uint32_t patch, std::uint32_t estimate, const Shape& receiver,
                       const std::array<double, 5>& u, const EmitterChoice::Choice& choice,
                       RayBatch& batch) const {
    const Emitter& emitter = emitter_shapes_[choice.emitter];
    const std::size_t next = batch.size;
    const double factor = look_at(*receiver.patch, receiver.points, *emitter.patch, emitter.points,
                                  {u[0], u[1], u[2], u[3]}, emitter.near, batch.rays[next]);
    if (!(factor > 0))
        return;
    batch.samples[next] = {patch, estimate, factor / choice.chance * emitter.emission};
    batch.targets[next] = emitter.patch->facet;
    ++batch.size;
}

void DirectLight::send(RayBatch& batch) {
    const std::size_t size = std::exchange(batch.size, 0);
    const std::span blocked = std::span(batch.blocked).first(size);
    if (needs_.visibility) {
        tracer_.occluded_stream(std::span(batch.rays).first(size),
                                std::span(batch.targets).first(size), blocked);
        batch.traced += size;
    } else {
        std::ranges::fill(blocked, std::uint8_t{0});
    }
    for (std::size_t k = 0; k < size; ++k) {
        const auto& [patch, estimate, light] = batch.samples[k];
        unblocked_[patch] += mean_of_channels(light);
        if (!blocked[k]) {
            sum_[patch * seeds_.size() + estimate] += light;
            ++hits_[patch];
        }
    }
}

void DirectLight::save(StateWriter& state) const {
    state.add(std::span<const Vec3>(sum_));
    state.add(std::span<const std::uint32_t>(samples_));
    state.add(std::span<const std::uint32_t>(hits_));
    state.add(std::span<const double>(unblocked_));
}

void DirectLight::load(StateReader& state) {
    state.get(std::span(sum_), bounds::non_negative);
    // A patch for which shadow rays no longer pay keeps its sums, but has no samples.
    constexpr double most_forgotten = 1u << 20;
    const auto check_mean = [](double sum, double samples) {
        if (sum > largest_radiosity * (samples > 0 ? samples : most_forgotten))
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
}

} // namespace hemilux
