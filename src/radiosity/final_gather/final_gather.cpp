#include "radiosity/final_gather/final_gather.h"

#include "parallel/workers.h"
#include "radiosity/form_factors/point_to_patch.h"
#include "radiosity/rays/receivers.h"
#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/solving/stop_flag.h"
#include "radiosity/stored_transport/small_emitters.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t points_per_chunk = 16, rays_per_batch = 4096;

/// Points on one facet whose samples are of one block of so many use the same chances of emitters:
/// they lie near each other.
constexpr std::uint32_t shared_weights = 64;

/// A patch whose light is met from so near, in sides of a square of its area, is not taken to send
/// the same, or a linear function, all over: the light that it reflects there is gathered too. So
/// often at the most.
constexpr double near_sides = .5;
constexpr unsigned most_bounces = 8;

/// So many paths go on at the most where they end by chance alone: else they would not end in a
/// closed room of reflectance 1.
constexpr double most_kept = .9;

} // namespace

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                         unsigned random_rays, unsigned shadow_rays)
    : FinalGather(mesh, tracer, light, random_rays, shadow_rays, small_emitters(mesh)) {}

FinalGather::FinalGather(const Mesh& mesh, const Tracer& tracer, PatchLight light,
                         unsigned random_rays, unsigned shadow_rays,
                         const std::vector<std::uint32_t>& emitters)
    : mesh_(mesh), tracer_(tracer), light_(light), random_rays_(random_rays),
      shadow_rays_(shadow_rays), left_out_(mesh.patches().size(), Vec3(0.0)),
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
    const std::size_t rays_of_estimate = std::size_t{random_rays_} * rounds_;
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
    const bool any = !emitters_.empty();
    if (any)
        weigh(point, batch);
    const bool by_shadow_rays = any && !batch.cut.dark() && batch.cut.pays();
    const Frame frame = Frame::from_normal(point.normal);
    const std::uint32_t random_rays = random_rays_ * rounds_, shadow_rays = shadow_rays_ * rounds_;
    const bool finds_light = find_ == Find::light;
    for (std::size_t e = 0; e < estimates; ++e, ++place) {
        SobolBlocks<5> numbers(hash_words({seed, e}));
        for (std::uint32_t k = 0; k < random_rays; ++k) {
            const auto u = numbers.at(k);
            Ray ray{point.position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = point.facet;
            batch.random.push_back(ray);
            batch.from_patch.push_back({place, Vec3(1.0 / random_rays)});
            batch.sees_emission.push_back(any && !by_shadow_rays);
            batch.seeds.push_back(hash_words({seed, e, k}));
            batch.in_gather.push_back(!finds_light);
            batch.ends.push_back(false);
        }
        if (by_shadow_rays && finds_light)
            add_shadow_rays(point, numbers, 0, shadow_rays, place, batch);
    }
}

void FinalGather::add_shadow_rays(const SurfacePoint& point, SobolBlocks<5>& numbers,
                                  std::uint32_t first, std::uint32_t count, std::uint32_t place,
                                  Batch& batch) const {
    EmitterChoice::Choices choices;
    std::uint32_t chosen = none; // the block of the choices
    for (std::uint32_t k = first; k < first + count; ++k) {
        const auto u = numbers.at(k);
        if (std::exchange(chosen, k / samples_per_block) != k / samples_per_block)
            choice_.choose(batch.cut, numbers.coordinate(4), choices);
        const auto& [index, chance] = choices[k % samples_per_block];
        const Emitter& emitter = emitters_[index];
        Ray ray{};
        const double factor = look_from(point.position, point.normal, point.facet, emitter.side,
                                        emitter.points, {u[2], u[3]}, emitter.near, ray);
        if (!(factor > 0))
            continue;
        batch.shadow.push_back(ray);
        batch.targets.push_back(emitter.side.facet);
        batch.to_emitter.push_back(
            {place, factor / chance / count * mesh_.material(emitter.side).emission});
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

void FinalGather::weigh(const SurfacePoint& point, Batch& batch) const {
    if (point.patch == none)
        choice_.weigh(point.position, point.normal, batch.cut);
    else if (point.patch != batch.weighed)
        choice_.weigh(point.patch, batch.cut);
    batch.weighed = point.patch;
}

bool FinalGather::is_near(const Met& met, unsigned bounce) const {
    return find_ != Find::spread_however_near && bounce < most_bounces &&
           met.distance * met.distance < near_sides * near_sides * mesh_.patches()[met.patch].area;
}

bool FinalGather::end_ray(const Batch& batch, const Met& met, unsigned bounce,
                          std::span<Vec3> found) const {
    const Material& material = mesh_.material(met.patch);
    const bool reflects = material.reflectance != Vec3(0.0);
    const bool near = reflects && is_near(met, bounce);
    const Vec3 left_out = left_out_of(batch, met.ray, met.patch);
    const auto& [place, share] = batch.from_patch[met.ray];
    if (find_ == Find::light) {
        const Vec3 light =
            near ? material.emission : radiosity_at(mesh_, light_, met.patch, met.point);
        found[place] += share * (light - left_out);
        return near;
    }
    if (!batch.in_gather[met.ray])
        found[place] += share * (light_.radiosity[met.patch] - left_out);
    return reflects && !batch.ends[met.ray];
}

/// One ray at random, and one to an emitter where such are taken, of a path that goes on.
void FinalGather::go_on(const Batch& from, const Met& met, bool in_gather, Batch& next,
                        std::span<Vec3> found) const {
    const std::uint64_t seed = from.seeds[met.ray];
    const Patch& on = mesh_.patches()[met.patch];
    const auto& [place, share] = from.from_patch[met.ray];
    // Russian roulette (Arvo and Kirk 1990) keeps the paths in narrow gaps and bright rooms short.
    const Vec3& rho = mesh_.material(on).reflectance;
    const double kept =
        std::min(std::max({rho.x, rho.y, rho.z}), find_ == Find::light ? 1 : most_kept);
    if (Rng(hash_words({seed, 2})).uniform() >= kept)
        return;
    const SurfacePoint at{met.point, on.normal, on.facet, met.patch};
    Continuation step{.seed = seed,
                      .place = place,
                      .light = share * rho / kept,
                      .in_gather = in_gather,
                      .ends = false,
                      .any = !in_gather && !emitters_.empty()};
    if (step.any)
        weigh(at, next);
    add_rays(at, step, next);
    if (find_ == Find::light || in_gather)
        return;
    // The light of another point of the patch, which is as right on average, by the same numbers.
    SurfacePoint other = at;
    Rng rng(hash_words({seed, 3}));
    const double u = rng.uniform(), v = rng.uniform();
    other.position = PolygonSampler(on.shape).sample({u, v});
    if (from.in_gather[met.ray]) // which reads the linear function there
        found[place] -= share / kept *
                        (radiosity_at(mesh_, light_, met.patch, at.position) -
                         radiosity_at(mesh_, light_, met.patch, other.position));
    step.light = -step.light;
    step.ends = true;
    add_rays(other, step, next);
}

void FinalGather::add_rays(const SurfacePoint& at, const Continuation& step, Batch& next) const {
    Rng rng(step.seed);
    const bool by_shadow_rays = step.any && !next.cut.dark() && next.cut.pays();
    Ray further{at.position, Frame::from_normal(at.normal).to_world(sample_cosine(rng))};
    further.from = at.facet;
    next.random.push_back(further);
    next.from_patch.push_back({step.place, step.light});
    next.sees_emission.push_back(step.any && !by_shadow_rays);
    next.seeds.push_back(hash_words({step.seed, 1}));
    next.in_gather.push_back(step.in_gather);
    next.ends.push_back(step.ends);
    if (!by_shadow_rays)
        return;
    EmitterChoice::Choices choices;
    std::array<double, std::tuple_size_v<EmitterChoice::Choices>> which{};
    which.fill(rng.uniform());
    choice_.choose(next.cut, which.data(), choices);
    const auto& [index, chance] = choices.front();
    const Emitter& emitter = emitters_[index];
    const double u = rng.uniform(), v = rng.uniform();
    Ray shadow{};
    const double factor = look_from(at.position, at.normal, at.facet, emitter.side, emitter.points,
                                    {u, v}, emitter.near, shadow);
    if (!(factor > 0))
        return;
    next.shadow.push_back(shadow);
    next.targets.push_back(emitter.side.facet);
    next.to_emitter.push_back(
        {step.place, factor / chance * step.light * mesh_.material(emitter.side).emission});
}

void FinalGather::send(Batch& batch, std::span<Vec3> found) const {
    std::vector<std::uint32_t> met_first;
    for (unsigned bounce = 0; !batch.random.empty(); ++bounce) {
        send_shadow_rays(batch,
                         [&](std::uint32_t place, const Vec3& light) { found[place] += light; });
        batch.receivers.clear();
        find_receivers(batch.random, mesh_, tracer_, batch.receivers);
        std::vector<Met> further;
        for (std::size_t k = 0; k < batch.random.size(); ++k) {
            const std::uint32_t patch = batch.receivers[k];
            if (patch == escaped || patch == absorbed)
                continue;
            const Patch& on = mesh_.patches()[patch];
            const Ray& ray = batch.random[k];
            const double along = glm::dot(ray.direction, on.normal);
            const double way =
                along < 0 ? std::max(glm::dot(on.centre - ray.origin, on.normal) / along, 0.0) : 0;
            const Met met{k, patch, ray.origin + way * ray.direction, way};
            if (end_ray(batch, met, bounce, found))
                further.push_back(met);
        }
        // Those on one patch after each other, as emitters are weighed for it.
        std::ranges::stable_sort(further, {}, &Met::patch);
        Batch next;
        for (const Met& met : further)
            go_on(batch, met, batch.in_gather[met.ray] && is_near(met, bounce), next, found);
        rays_ += batch.random.size();
        if (bounce == 0)
            met_first = std::move(batch.receivers);
        batch = std::move(next);
    }
    batch.receivers = std::move(met_first);
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
        add_shadow_rays(points[k], numbers, first, count, k, batch);
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
                found[place].irradiance +=
                    share * (radiosity_at(mesh_, light_, patch,
                                          rays[k].origin + hit.t * rays[k].direction) -
                             left_out_[patch]);
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
        const SurfacePoint& point = points[k];
        const auto& [seed, first, count] = samples[k];
        const Frame frame = Frame::from_normal(point.normal);
        SobolBlocks<5> numbers(seed);
        for (std::uint32_t next = first; next < first + count; ++next) {
            const auto u = numbers.at(next);
            Ray ray{point.position, frame.to_world(cosine_direction({u[0], u[1]}))};
            ray.from = point.facet;
            batch.random.push_back(ray);
            batch.from_patch.push_back({k, Vec3(1.0 / count)});
        }
        if (batch.random.size() >= rays_per_batch)
            send_random_rays(batch, found);
    }
    send_random_rays(batch, found);
    return found;
}

GatheredTwice gather_twice(const PointsOverSurface& surface, FinalGather& gather,
                           std::size_t points, std::uint64_t seed, const Workers& workers,
                           const StopFlag& interrupted) {
    GatheredTwice found{surface.draw(points, hash_words({seed, 0})), {}};
    std::vector<SurfacePoint> at;
    std::vector<std::uint64_t> streams;
    for (const PatchPoint& point : found.points) {
        at.push_back(point.at);
        streams.push_back(hash_words({seed, at.size()}));
    }
    found.irradiance = gather.irradiance(at, streams, 2, workers, interrupted);
    return found;
}

} // namespace hemilux
