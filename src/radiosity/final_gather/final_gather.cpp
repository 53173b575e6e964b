#include "radiosity/final_gather/final_gather.h"

#include "radiosity/final_gather/linear_light.h"
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
#include <tuple>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t points_per_chunk = 16;

/// A patch whose light is met from so near, in sides of a square of its area, is not taken to send
/// the same, or a linear function, all over: the light that it reflects there is gathered too. So
/// often at the most.
constexpr double near_sides = .5;
constexpr unsigned most_bounces = 8;

} // namespace

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                         unsigned random_rays)
    : FinalGather(mesh, tracer, solution, random_rays, small_emitters(mesh)) {}

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, const Solution& solution,
                         unsigned random_rays, const std::vector<std::uint32_t>& emitters)
    : mesh_(mesh), tracer_(tracer), solution_(solution), random_rays_(random_rays),
      left_out_(mesh.patches().size(), Vec3(0.0)),
      sides_(whole_sides(mesh, one_of_each_side(mesh, emitters))), choice_(mesh, sides_) {
    for (const std::uint32_t i : emitters)
        left_out_[i] = mesh.material(i).emission;
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
        for (std::uint32_t k = 0; k < random_rays_; ++k) {
            const auto u = numbers.point(k);
            Ray ray{position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = facet;
            batch.random.push_back(ray);
            batch.from_patch.push_back({place, Vec3(1.0 / random_rays_)});
            batch.sees_emission.push_back(any && !by_shadow_rays);
            batch.seeds.push_back(hash_words({seed, e, k}));
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

/// One ray at random, and one to an emitter where such are taken, of a path that goes on.
void FinalGather::go_on(const SurfacePoint& point, const Vec3& light, std::uint32_t place,
                        std::uint64_t seed, Batch& batch) const {
    Rng rng(seed);
    const bool any = !emitters_.empty();
    if (any)
        choice_.weigh(point.position, point.normal, batch.cut);
    const bool by_shadow_rays = any && !batch.cut.dark() && batch.cut.pays();
    Ray ray{point.position, Frame::from_normal(point.normal).to_world(sample_cosine(rng))};
    ray.from = point.facet;
    batch.random.push_back(ray);
    batch.from_patch.push_back({place, light});
    batch.sees_emission.push_back(any && !by_shadow_rays);
    batch.seeds.push_back(hash_words({seed, 1}));
    if (!by_shadow_rays)
        return;
    EmitterChoice::Choices choices;
    std::array<double, std::tuple_size_v<EmitterChoice::Choices>> which{};
    which.fill(rng.uniform());
    choice_.choose(batch.cut, which.data(), choices);
    const auto& [index, chance] = choices.front();
    const Emitter& emitter = emitters_[index];
    const double u = rng.uniform(), v = rng.uniform();
    const double factor = look_from(point.position, point.normal, point.facet, emitter.side,
                                    emitter.points, {u, v}, emitter.near, ray);
    if (!(factor > 0))
        return;
    batch.shadow.push_back(ray);
    batch.targets.push_back(emitter.side.facet);
    batch.to_emitter.push_back(
        {place, factor / chance * light * mesh_.material(emitter.side).emission});
}

/// The light of a random ray that struck a patch; near ones are followed, if they may.
void FinalGather::receive(std::uint32_t patch, const Ray& ray, const Batch::Sample& sample,
                          const Vec3& left_out, const std::uint64_t* seed, Batch& next,
                          std::span<Vec3> found) const {
    const Patch& on = mesh_.patches()[patch];
    const double along = glm::dot(ray.direction, on.normal);
    const double way =
        along < 0 ? std::max(glm::dot(on.centre - ray.origin, on.normal) / along, 0.0) : 0;
    const Vec3 point = ray.origin + way * ray.direction;
    const Material& material = mesh_.material(on);
    const bool is_near = way * way < near_sides * near_sides * on.area;
    if (seed && is_near && material.reflectance != Vec3(0.0)) {
        found[sample.place] += sample.light * (material.emission - left_out);
        // Russian roulette (Arvo and Kirk 1990) keeps the paths in narrow gaps short.
        const Vec3& rho = material.reflectance;
        const double kept = std::max({rho.x, rho.y, rho.z});
        if (Rng(hash_words({*seed, 2})).uniform() < kept)
            go_on({point, on.normal, on.facet}, sample.light * rho / kept, sample.place, *seed,
                  next);
        return;
    }
    found[sample.place] += sample.light * (radiosity_at(mesh_, solution_, patch, point) - left_out);
}

void FinalGather::send(Batch& batch, std::span<Vec3> found) {
    for (unsigned bounce = 0; !batch.random.empty(); ++bounce) {
        batch.blocked.resize(batch.shadow.size());
        tracer_.occluded_stream(batch.shadow, batch.targets, batch.blocked);
        for (std::size_t k = 0; k < batch.shadow.size(); ++k)
            if (!batch.blocked[k])
                found[batch.to_emitter[k].place] += batch.to_emitter[k].light;
        batch.receivers.clear();
        find_receivers(batch.random, mesh_, tracer_, batch.receivers);
        Batch next;
        for (std::size_t k = 0; k < batch.random.size(); ++k) {
            const std::uint32_t patch = batch.receivers[k];
            if (patch == escaped || patch == absorbed)
                continue;
            receive(patch, batch.random[k], batch.from_patch[k],
                    batch.sees_emission[k] ? Vec3(0.0) : left_out_[patch],
                    bounce < most_bounces ? &batch.seeds[k] : nullptr, next, found);
        }
        rays_ += batch.shadow.size() + batch.random.size();
        batch = std::move(next);
    }
}

} // namespace hemilux
