#include "radiosity/light/division/division_weights.h"

#include "geometry/frame.h"
#include "radiosity/light/final_gather/surface_points.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <optional>

namespace hemilux {
namespace {

constexpr std::size_t points_of_target = 4096, points_per_chunk = 64, rays_of_point = 4;

/// This is what a ray from a point of the target meets.
struct Read {
    std::uint32_t patch = none;
    double counts = 0; ///< of the point's weight
};

Read read_along(const Ray& ray, const Vec3& reflectance, const Mesh& mesh, const Tracer& tracer) {
    const std::optional<Hit> hit = tracer.closest(ray);
    const std::uint32_t patch = hit ? mesh.patch_at(*hit) : none;
    if (patch == none)
        return {};
    const double near = std::min(mesh.patches()[patch].area / (hit->t * hit->t), 1.0);
    return {patch, near * mean_of_channels(reflectance * reflectance) / double(rays_of_point)};
}

} // namespace

std::vector<double> division_weights(const Mesh& mesh, const Tracer& tracer,
                                     std::span<const double> weight, std::uint64_t seed,
                                     const Workers& workers) {
    const std::vector<PatchPoint> points =
        PointsOverSurface(mesh, weight).draw(points_of_target, seed);
    std::vector<Read> reads(points.size() * rays_of_point);
    workers.for_chunks(points.size(), points_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const SurfacePoint& at = points[k].at;
            Rng rng(hash_words({seed, k}));
            const Frame frame = Frame::from_normal(at.normal);
            for (std::size_t r = 0; r < rays_of_point; ++r) {
                const Ray ray = at.ray(frame.to_world(sample_cosine(rng)));
                reads[k * rays_of_point + r] =
                    read_along(ray, mesh.material(points[k].patch).reflectance, mesh, tracer);
            }
        }
    });
    std::vector<double> counts(weight.begin(), weight.end());
    for (std::size_t n = 0; n < reads.size(); ++n) {
        const PatchPoint& point = points[n / rays_of_point];
        const auto& [patch, share] = reads[n];
        if (patch != none)
            counts[patch] += share * weight[point.patch] * point.area / mesh.patches()[patch].area;
    }
    return counts;
}

} // namespace hemilux
