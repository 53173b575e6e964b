#include "radiosity/light/final_gather/surface_points.h"

#include "geometry/polygon_sampler.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {

PointsOverSurface::PointsOverSurface(const Mesh& mesh, std::span<const double> density)
    : mesh_(mesh), density_(density.begin(), density.end()) {
    density_.resize(mesh.patches().size(), 1);
    double end = 0;
    for (std::uint32_t i = 0; i < density_.size(); ++i) {
        if (mesh.material(i).reflectance != Vec3(0.0))
            end += density_[i] * mesh.patches()[i].area;
        ends_.push_back(end);
    }
}

std::vector<PatchPoint> PointsOverSurface::draw(std::size_t count, std::uint64_t seed) const {
    std::vector<PatchPoint> points;
    const double all = ends_.empty() ? 0 : ends_.back();
    if (!(all > 0))
        return points;
    Rng rng(seed);
    const double each = all / static_cast<double>(count);
    for (double next = each * rng.uniform(); next < all; next += each) {
        const auto i =
            static_cast<std::uint32_t>(std::ranges::upper_bound(ends_, next) - ends_.begin());
        const Patch& patch = mesh_.patches()[i];
        const double u = rng.uniform(), v = rng.uniform();
        points.push_back({{PolygonSampler(patch.shape).sample({u, v}), patch.normal, patch.facet},
                          i,
                          each / density_[i]});
    }
    return points;
}

std::vector<double> reflected_squares(const Mesh& mesh, std::span<const Vec3> radiosity) {
    std::vector<double> squares;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 reflected = radiosity[i] - mesh.material(i).emission;
        squares.push_back(mesh.patches()[i].area * glm::dot(reflected, reflected));
    }
    return squares;
}

std::vector<double> mixed_density(const Mesh& mesh, std::span<const double> weight,
                                  std::initializer_list<std::span<const double>> quantities) {
    const auto patches = mesh.patches();
    std::vector<double> density(patches.size()), areas;
    for (const Patch& patch : patches)
        areas.push_back(patch.area);
    const auto add = [&](std::span<const double> quantity) {
        const auto of_patch = [&](std::size_t i) {
            return (weight.empty() ? 1 : weight[i]) * std::max(quantity[i], 0.0);
        };
        double sum = 0;
        for (std::size_t i = 0; i < quantity.size(); ++i)
            sum += of_patch(i);
        for (std::size_t i = 0; i < quantity.size() && sum > 0; ++i)
            if (areas[i] > 0)
                density[i] += of_patch(i) / sum / areas[i];
    };
    add(areas);
    add(std::vector<double>(patches.size(), 1));
    for (const std::span<const double> quantity : quantities)
        add(quantity);
    return density;
}

std::vector<PatchPoint> points_on_patches(const Mesh& mesh, std::span<const std::uint32_t> some,
                                          unsigned max_rows, std::uint64_t seed) {
    constexpr double min_rows = 3;
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
        // The number goes by the side of a square of the patch's area, against one of the mean.
        const double rows =
            std::clamp(std::round(min_rows * std::sqrt(patches[i].area * count / area)), min_rows,
                       double(max_rows));
        for (double row = 0; row < rows; ++row)
            for (double column = 0; column < rows; ++column) {
                const double u = (column + rng.uniform()) / rows, v = (row + rng.uniform()) / rows;
                points.push_back({{sampler.sample({u, v}), patches[i].normal, patches[i].facet, i},
                                  i,
                                  patches[i].area / (rows * rows)});
            }
    }
    return points;
}

} // namespace hemilux
