#include "radiosity/final_gather/final_gather.h"

#include "radiosity/form_factors/point_to_patch.h"
#include "radiosity/gathering/small_emitters.h"
#include "radiosity/rays/receivers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/solving/stop_flag.h"

#include <algorithm>
#include <array>

namespace hemilux {
namespace {

constexpr std::size_t points_per_chunk = 16, rays_per_batch = 4096;

/// Points on one facet whose samples are of one block of so many use the same chances of emitters:
/// they lie near each other.
constexpr std::uint32_t shared_weights = 64;

} // namespace

/// Rays that are not traced yet, of some points.
struct FinalGather::Batch {
    struct Sample {
        std::uint32_t place; ///< of the estimate
        Vec3 light; ///< if nothing is in the way; of a random ray, its share of what it meets
    };
    std::vector<Ray> shadow, random;
    std::vector<Sample> to_emitter, from_patch;
    std::vector<std::uint32_t> targets;
    std::vector<std::uint32_t> receivers;
    std::vector<std::uint8_t> blocked;
    std::vector<bool> sees_emission; ///< of random rays: emitters are left to them
    EmitterChoice::Cut cut;

    void clear_shadow_rays() {
        shadow.clear();
        targets.clear();
        to_emitter.clear();
    }
};

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity)
    : FinalGather(mesh, tracer, radiosity, small_emitters(mesh)) {}

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, std::span<const Vec3> radiosity,
                         const std::vector<std::uint32_t>& emitters)
    : mesh_(mesh), tracer_(tracer), radiosity_(radiosity),
      without_emitters_(radiosity.begin(), radiosity.end()),
      sides_(whole_sides(mesh, one_of_each_side(mesh, emitters))), choice_(mesh, sides_) {
    for (const std::uint32_t i : emitters)
        without_emitters_[i] -= mesh.material(i).emission;
    for (const Patch& side : sides_)
        emitters_.push_back({side, PolygonSampler(side.shape), near_radii * radius_of(side)});
}

std::vector<Vec3> FinalGather::irradiance(std::span<const SurfacePoint> points,
                                          std::span<const std::uint64_t> streams,
                                          std::size_t estimates, const Workers& workers,
                                          const StopFlag& interrupted) {
    std::vector<Vec3> found(points.size() * estimates, Vec3(0.0));
    const std::size_t rays_of_estimate = std::size_t{random_rays} * rounds_;
    if (receivers_)
        receivers_->assign(found.size() * rays_of_estimate, absorbed);
    workers.for_chunks_with(
        points.size(), points_per_chunk, [] { return Batch(); },
        [&](Batch& batch, std::size_t begin, std::size_t end) {
            std::size_t place = begin * estimates * rays_of_estimate; // of the rays in the batch
            for (std::size_t k = begin; k < end && !interrupted; ++k) {
                gather(points[k], streams[k], estimates, static_cast<std::uint32_t>(k * estimates),
                       batch);
                if (k + 1 < end && batch.random.size() < rays_per_batch)
                    continue;
                send(batch, found);
                if (receivers_)
                    std::ranges::copy(batch.receivers,
                                      receivers_->begin() + static_cast<std::ptrdiff_t>(place));
                place += batch.receivers.size();
            }
        });
    return found;
}

void FinalGather::gather(const SurfacePoint& point, std::uint64_t seed, std::size_t estimates,
                         std::uint32_t place, Batch& batch) const {
    const auto& [position, normal, facet] = point;
    EmitterChoice::Cut& cut = batch.cut;
    const bool any = !emitters_.empty();
    if (any)
        choice_.weigh(position, normal, cut);
    const bool by_shadow_rays = any && !cut.dark() && cut.pays();
    const Frame frame = Frame::from_normal(normal);
    for (std::size_t e = 0; e < estimates; ++e, ++place) {
        SobolBlocks<5> numbers(hash_words({seed, e}));
        for (std::uint32_t round = 0; round < rounds_; ++round) {
            numbers.move_to(round * random_rays);
            for (std::uint32_t k = 0; k < random_rays; ++k) {
                const auto u = numbers.point(k);
                Ray ray{position, frame.to_world(cosine_direction({u[0], u[1]}))};
                ray.from = facet;
                batch.random.push_back(ray);
                batch.from_patch.push_back({place, Vec3(1.0 / (random_rays * rounds_))});
                batch.sees_emission.push_back(any && !by_shadow_rays);
            }
            if (by_shadow_rays)
                add_shadow_rays(point, numbers, 0, shadow_rays, shadow_rays * rounds_, place,
                                batch);
        }
    }
}

void FinalGather::add_shadow_rays(const SurfacePoint& point, const SobolBlocks<5>& numbers,
                                  std::uint32_t first, std::uint32_t count, std::uint32_t of,
                                  std::uint32_t place, Batch& batch) const {
    const auto& [position, normal, facet] = point;
    EmitterChoice::Choices choices;
    choice_.choose(batch.cut, numbers.coordinate(4), choices);
    for (std::uint32_t k = first; k < first + count; ++k) {
        const auto u = numbers.point(k);
        const Emitter& emitter = emitters_[choices[k].emitter];
        Ray ray{};
        const double factor = look_from(position, normal, facet, emitter.side, emitter.points,
                                        {u[2], u[3]}, emitter.near, ray);
        if (!(factor > 0))
            continue;
        batch.shadow.push_back(ray);
        batch.targets.push_back(emitter.side.facet);
        batch.to_emitter.push_back(
            {place, factor / choices[k].chance / of * mesh_.material(emitter.side).emission});
    }
}

/// Calls add(place, light) for what arrives.
template <class Add>
void FinalGather::send_shadow_rays(Batch& batch, const Add& add) const {
    batch.blocked.resize(batch.shadow.size());
    tracer_.occluded_stream(batch.shadow, batch.targets, batch.blocked);
    for (std::size_t k = 0; k < batch.shadow.size(); ++k)
        if (!batch.blocked[k])
            add(batch.to_emitter[k].place, batch.to_emitter[k].light);
    rays_ += batch.shadow.size();
    batch.clear_shadow_rays();
}

void FinalGather::send(Batch& batch, std::span<Vec3> found) {
    send_shadow_rays(batch, [&](std::uint32_t place, const Vec3& light) { found[place] += light; });
    batch.receivers.clear();
    find_receivers(batch.random, mesh_, tracer_, batch.receivers);
    for (std::size_t k = 0; k < batch.random.size(); ++k) {
        const std::uint32_t patch = batch.receivers[k];
        if (patch == escaped || patch == absorbed)
            continue;
        const Vec3& sent = batch.sees_emission[k] ? radiosity_[patch] : without_emitters_[patch];
        found[batch.from_patch[k].place] += batch.from_patch[k].light * sent;
    }
    rays_ += batch.random.size();
    batch.random.clear();
    batch.from_patch.clear();
    batch.sees_emission.clear();
}

std::vector<DirectLight> FinalGather::direct(std::span<const SurfacePoint> points,
                                             std::span<const GatherSamples> samples,
                                             Shadows shadows) const {
    std::vector<DirectLight> found(points.size());
    Batch batch;
    const auto arrive = [&](std::uint32_t place, const Vec3& light) {
        found[place].arriving += light;
    };
    for (std::uint32_t k = 0; k < points.size() && !emitters_.empty(); ++k) {
        const auto& [seed, first, count] = samples[k];
        const bool alike = k > 0 && points[k].facet == points[k - 1].facet &&
                           first / shared_weights == samples[k - 1].first / shared_weights;
        if (!alike)
            choice_.weigh(points[k].position, points[k].normal, batch.cut);
        if (batch.cut.dark())
            continue;
        const std::size_t before = batch.to_emitter.size();
        SobolBlocks<5> numbers(seed);
        for (std::uint32_t next = first, end = first + count; next < end;) {
            const std::uint32_t in_block = next % samples_per_block;
            const std::uint32_t n =
                std::min<std::uint32_t>(samples_per_block - in_block, end - next);
            numbers.move_to(next);
            add_shadow_rays(points[k], numbers, in_block, n, count, k, batch);
            next += n;
        }
        double by_nearness = 0;
        for (std::size_t ray = before; ray < batch.to_emitter.size(); ++ray) {
            const Vec3& light = batch.to_emitter[ray].light;
            found[k].unshadowed += light;
            by_nearness += mean_of_channels(light) / batch.shadow[ray].t_max;
        }
        if (by_nearness > 0)
            found[k].nearness = by_nearness / mean_of_channels(found[k].unshadowed);
        if (shadows == Shadows::left_out)
            batch.clear_shadow_rays();
        else if (batch.shadow.size() >= rays_per_batch)
            send_shadow_rays(batch, arrive);
    }
    send_shadow_rays(batch, arrive);
    return found;
}

/// Each ray's light is its share of what it meets.
void FinalGather::send_random_rays(Batch& batch, std::span<IndirectLight> found) const {
    std::array<FacetHit, rays_at_a_time> hits;
    for (std::size_t begin = 0; begin < batch.random.size(); begin += hits.size()) {
        const std::size_t n = std::min(hits.size(), batch.random.size() - begin);
        const auto rays = std::span(batch.random).subspan(begin, n);
        tracer_.closest_stream(rays, std::span(hits).first(n));
        for (std::size_t k = 0; k < n; ++k) {
            if (hits[k].facet == none)
                continue;
            const Hit hit = tracer_.locate(rays[k], hits[k].facet);
            const auto& [place, share] = batch.from_patch[begin + k];
            constexpr double touching = 1e-6;
            found[place].nearness += share.x / std::max(hit.t, touching);
            if (const std::uint32_t patch = mesh_.patch_at(hit); patch != none)
                found[place].irradiance += share * without_emitters_[patch];
        }
    }
    rays_ += batch.random.size();
    batch.random.clear();
    batch.from_patch.clear();
}

std::vector<IndirectLight> FinalGather::indirect(std::span<const SurfacePoint> points,
                                                 std::span<const GatherSamples> samples) const {
    std::vector<IndirectLight> found(points.size());
    Batch batch;
    for (std::uint32_t k = 0; k < points.size(); ++k) {
        const auto& [position, normal, facet] = points[k];
        const auto& [seed, first, count] = samples[k];
        const Frame frame = Frame::from_normal(normal);
        SobolBlocks<5> numbers(seed);
        for (std::uint32_t next = first; next < first + count; ++next) {
            const auto u = numbers.at(next);
            Ray ray{position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = facet;
            batch.random.push_back(ray);
            batch.from_patch.push_back({k, Vec3(1.0 / count)});
        }
        if (batch.random.size() >= rays_per_batch)
            send_random_rays(batch, found);
    }
    send_random_rays(batch, found);
    return found;
}

} // namespace hemilux
