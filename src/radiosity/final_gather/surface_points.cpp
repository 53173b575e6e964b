#include "radiosity/final_gather/surface_points.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

std::vector<PatchPoint> points_over_surface(const Mesh& mesh, std::size_t count,
                                            std::uint64_t seed) {
    const auto patches = mesh.patches();
    const auto area_of = [&](std::uint32_t i) {
        return mesh.material(i).reflectance != Vec3(0.0) ? patches[i].area : 0;
    };
    double area = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        area += area_of(i);
    std::vector<PatchPoint> points;
    if (!(area > 0))
        return points;
    Rng rng(seed);
    const double each = area / static_cast<double>(count);
    double next = each * rng.uniform(), end = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        end += area_of(i);
        if (next >= end)
            continue;
        const PolygonSampler sampler(patches[i].shape);
        for (; next < end; next += each) {
            const double u = rng.uniform(), v = rng.uniform();
            points.push_back(
                {{sampler.sample({u, v}), patches[i].normal, patches[i].facet}, i, each});
        }
    }
    return points;
}

std::vector<PatchPoint> points_on_patches(const Mesh& mesh, std::span<const std::uint32_t> some,
                                          unsigned most_rows, std::uint64_t seed) {
    constexpr double least_rows = 3;
    const auto patches = mesh.patches();
    double area = 0, count = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        if (mesh.material(i).reflectance != Vec3(0.0)) {
            area += patches[i].area;
            ++count;
        }
    std::vector<PatchPoint> points;
    for (const std::uint32_t i : some) {
        if (mesh.material(i).reflectance == Vec3(0.0))
            continue;
        const PolygonSampler sampler(patches[i].shape);
        Rng rng(hash_words({seed, i}));
        // By the side of a square of the patch's area, against one of the mean.
        const double rows =
            std::clamp(std::round(least_rows * std::sqrt(patches[i].area * count / area)),
                       least_rows, double(most_rows));
        for (double row = 0; row < rows; ++row)
            for (double column = 0; column < rows; ++column) {
                const double u = (column + rng.uniform()) / rows, v = (row + rng.uniform()) / rows;
                points.push_back({{sampler.sample({u, v}), patches[i].normal, patches[i].facet},
                                  i,
                                  patches[i].area / (rows * rows)});
            }
    }
    return points;
}

} // namespace hemilux
