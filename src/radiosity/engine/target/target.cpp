#include "radiosity/engine/target/target.h"

#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <bit>

namespace hemilux {
namespace {

constexpr std::size_t points_per_chunk = 64;

/// Returns what the rays from some points meet, point by point.
std::vector<std::uint32_t> met_from(std::span<const SurfacePoint> points, std::size_t first,
                                    const Mesh& mesh, const Tracer& tracer, unsigned rays) {
    std::vector<Ray> all;
    for (std::size_t k = 0; k < points.size(); ++k) {
        Rng rng(hash_words({first + k}));
        const Frame frame = Frame::from_normal(points[k].normal);
        for (unsigned r = 0; r < rays; ++r)
            all.push_back(points[k].ray(frame.to_world(sample_cosine(rng))));
    }
    std::vector<std::uint32_t> met;
    find_receivers(all, mesh, tracer, met);
    return met;
}

} // namespace

std::vector<double> weights_of_groups(const Mesh& mesh, std::span<const std::uint32_t> groups) {
    std::vector<double> weights;
    for (const Patch& patch : mesh.patches()) {
        const std::uint32_t group = mesh.scene().facets[patch.facet].group;
        weights.push_back(std::ranges::find(groups, group) != groups.end() ? 1 : 0);
    }
    return weights;
}

std::vector<double> weights_of_points(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const SurfacePoint> points, unsigned rays,
                                      const Workers& workers) {
    std::vector<std::vector<std::uint32_t>> met((points.size() + points_per_chunk - 1) /
                                                points_per_chunk);
    workers.for_chunks(points.size(), points_per_chunk, [&](std::size_t begin, std::size_t end) {
        met[begin / points_per_chunk] =
            met_from(points.subspan(begin, end - begin), begin, mesh, tracer, rays);
    });
    std::vector<double> weights(mesh.patches().size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::uint32_t on = points[k].patch;
        const Vec3 rho = mesh.material(on).reflectance;
        const double reflected = mean_of_channels(rho * rho);
        weights[on] += 1;
        for (unsigned r = 0; r < rays; ++r) {
            const std::uint32_t patch = met[k / points_per_chunk][k % points_per_chunk * rays + r];
            if (patch != escaped && patch != absorbed)
                weights[patch] += reflected / rays;
        }
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = mesh.patches()[i].area > 0 ? weights[i] / mesh.patches()[i].area : 0;
    const double largest = weights.empty() ? 0 : std::ranges::max(weights);
    for (double& weight : weights)
        weight = largest > 0 ? weight / largest : 0;
    return weights;
}

std::uint64_t hash_of_weights(std::span<const double> weights) {
    std::uint64_t hash = 0;
    for (const double each : weights)
        hash = hash_words({hash, std::bit_cast<std::uint64_t>(each)});
    return hash;
}

void add_weights(std::vector<double>& weights, std::span<const double> others) {
    weights.resize(std::max(weights.size(), others.size()));
    for (std::size_t i = 0; i < others.size(); ++i)
        weights[i] = std::max(weights[i], others[i]);
}

} // namespace hemilux
