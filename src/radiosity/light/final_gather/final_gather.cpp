#include "radiosity/light/final_gather/final_gather.h"

#include "parallel/ranks.h"
#include "parallel/workers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// The number of rays that are traced together; fewer take longer each. A thread or rank takes as
/// many points as have so many rays, 16 at most.
constexpr std::size_t rays_per_batch = 4096, max_points_per_chunk = 16;

} // namespace

std::vector<Vec3> FinalGather::irradiance(std::span<const SurfacePoint> points,
                                          std::span<const std::uint64_t> streams,
                                          std::size_t estimates, const Workers& workers,
                                          const StopFlag& interrupted) {
    std::vector<Vec3> found(points.size() * estimates, Vec3(0.0));
    const std::size_t rays_of_point =
        estimates * rounds_ * (std::size_t{random_rays_} + shadow_rays_);
    const std::size_t points_per_chunk =
        std::clamp<std::size_t>(rays_per_batch / rays_of_point, 1, max_points_per_chunk);
    const OwnBlocks own(ranks_at_work(interrupted), points.size(), points_per_chunk);
    std::optional<OnThisRank> on_this_rank(interrupted);
    std::atomic<std::uint64_t> traced{0};
    workers.for_chunks(own.count(), points_per_chunk, [&](std::size_t first, std::size_t last) {
        const std::size_t begin = own.item(first), end = begin + (last - first);
        PathRays rays;
        for (std::size_t k = begin; k < end && !interrupted; ++k) {
            add_rays(points[k], streams[k], estimates, static_cast<std::uint32_t>(k * estimates),
                     rays);
            if (k + 1 < end && rays.random.size() < rays_per_batch)
                continue;
            traced += paths_.trace(std::exchange(rays, {}), found);
        }
    });
    on_this_rank.reset();
    own.gather(found, estimates);
    own.ranks().add_work(traced, 0);
    rays_ += own.ranks().sum(traced);
    agree(interrupted);
    return found;
}

/// Adds the rays of all estimates at one point.
void FinalGather::add_rays(const SurfacePoint& point, std::uint64_t seed, std::size_t estimates,
                           std::uint32_t place, PathRays& rays) const {
    const ReachedEmitters& emitters = paths_.emitters();
    emitters.weigh(point, rays.weighed);
    const bool by_shadow_rays = rays.weighed.pays();
    const Frame frame = Frame::from_normal(point.normal);
    const std::uint32_t random_rays = random_rays_ * rounds_, shadow_rays = shadow_rays_ * rounds_;
    for (std::size_t e = 0; e < estimates; ++e, ++place) {
        SobolBlocks<5> numbers(hash_words({seed, e}));
        for (std::uint32_t k = 0; k < random_rays; ++k) {
            const auto u = numbers.at(k);
            rays.add(point.ray(frame.to_world(cosine_direction({u[0], u[1]}))),
                     {.seed = hash_words({seed, e, k}),
                      .place = place,
                      .share = Vec3(1.0 / random_rays),
                      .sees_emission = !by_shadow_rays,
                      .only_reflected = only_reflected_});
        }
        if (by_shadow_rays && !only_reflected_)
            emitters.add_rays(point, rays.weighed, numbers, 0, shadow_rays, place, rays.shadow);
        if (!paths_.points().empty() && !only_reflected_)
            paths_.points().add_rays(point, PointEmitters::max_rays_of_point,
                                     Rng(hash_words({seed, e, 1})).uniform(), Vec3(1.0), place,
                                     rays.shadow);
    }
}

GatheredAtPoints gather_over(const PointsOverSurface& surface, FinalGather& gather,
                             std::size_t points, std::size_t estimates, std::uint64_t seed,
                             const Workers& workers, const StopFlag& interrupted) {
    GatheredAtPoints found{surface.draw(points, hash_words({seed, 0})), {}};
    std::vector<SurfacePoint> at;
    std::vector<std::uint64_t> streams;
    for (const PatchPoint& point : found.points) {
        at.push_back(point.at);
        streams.push_back(hash_words({seed, at.size()}));
    }
    found.irradiance = gather.irradiance(at, streams, estimates, workers, interrupted);
    return found;
}

} // namespace hemilux
