#include "radiosity/final_gather/final_gather.h"

#include "radiosity/form_factors/point_to_patch.h"
#include "radiosity/gathering/small_emitters.h"
#include "radiosity/rays/receivers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/solving/stop_flag.h"

namespace hemilux {
namespace {

constexpr std::size_t points_per_chunk = 16;

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
    workers.for_chunks_with(
        points.size(), points_per_chunk, [] { return Batch(); },
        [&](Batch& batch, std::size_t begin, std::size_t end) {
            if (interrupted)
                return;
            for (std::size_t k = begin; k < end; ++k)
                gather(points[k], streams[k], estimates, static_cast<std::uint32_t>(k * estimates),
                       batch);
            send(batch, found);
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
    EmitterChoice::Choices choices;
    for (std::size_t e = 0; e < estimates; ++e, ++place) {
        SobolBlocks<5> numbers(hash_words({seed, e}));
        numbers.move_to(0);
        for (std::uint32_t k = 0; k < random_rays; ++k) {
            const auto u = numbers.point(k);
            Ray ray{position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = facet;
            batch.random.push_back(ray);
            batch.from_patch.push_back({place, Vec3(1.0 / random_rays)});
            batch.sees_emission.push_back(any && !by_shadow_rays);
        }
        if (!by_shadow_rays)
            continue;
        choice_.choose(cut, numbers.coordinate(4), choices);
        for (std::uint32_t k = 0; k < shadow_rays; ++k) {
            const auto u = numbers.point(k);
            const Emitter& emitter = emitters_[choices[k].emitter];
            Ray ray{};
            const double factor = look_from(position, normal, facet, emitter.side, emitter.points,
                                            {u[2], u[3]}, emitter.near, ray);
            if (!(factor > 0))
                continue;
            batch.shadow.push_back(ray);
            batch.targets.push_back(emitter.side.facet);
            batch.to_emitter.push_back({place, factor / choices[k].chance / shadow_rays *
                                                   mesh_.material(emitter.side).emission});
        }
    }
}

void FinalGather::send(Batch& batch, std::span<Vec3> found) {
    batch.blocked.resize(batch.shadow.size());
    tracer_.occluded_stream(batch.shadow, batch.targets, batch.blocked);
    for (std::size_t k = 0; k < batch.shadow.size(); ++k)
        if (!batch.blocked[k])
            found[batch.to_emitter[k].place] += batch.to_emitter[k].light;
    batch.receivers.clear();
    find_receivers(batch.random, mesh_, tracer_, batch.receivers);
    for (std::size_t k = 0; k < batch.random.size(); ++k) {
        const std::uint32_t patch = batch.receivers[k];
        if (patch == escaped || patch == absorbed)
            continue;
        const Vec3& sent = batch.sees_emission[k] ? radiosity_[patch] : without_emitters_[patch];
        found[batch.from_patch[k].place] += batch.from_patch[k].light * sent;
    }
    rays_ += batch.shadow.size() + batch.random.size();
    for (auto* rays : {&batch.shadow, &batch.random})
        rays->clear();
    for (auto* samples : {&batch.to_emitter, &batch.from_patch})
        samples->clear();
    batch.targets.clear();
    batch.sees_emission.clear();
}

} // namespace hemilux
