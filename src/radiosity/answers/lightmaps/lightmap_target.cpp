#include "radiosity/answers/lightmaps/lightmap_target.h"

#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hemilux {
namespace {

/// Returns what of the irradiance at a texel counts.
Vec3 factor_of(const Mesh& mesh, const SurfacePoint& at, Bake bake) {
    return bake == Bake::radiosity
               ? colours_at(mesh, mesh.patches()[at.patch], at.position).reflectance
               : Vec3(1.0);
}

/// Returns how much a lightmap differs between a texel and those around it of the same chart
/// [W/m2].
double contrast_at(const Image& lightmap, const TexelMap& texels, const std::vector<bool>& covered,
                   std::size_t texel) {
    const int size = texels.size(), x = static_cast<int>(texel) % size,
              y = static_cast<int>(texel) / size;
    float most = 0;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, size - 1); ++row)
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, size - 1); ++column)
            if (const std::size_t other = texels.index(column, row);
                texels.shows(other) && !covered[other] &&
                texels.triangle(other).chart == texels.triangle(texel).chart)
                most =
                    std::max(most, glm::distance(lightmap.pixels[other], lightmap.pixels[texel]));
    return double(most);
}

/// Returns how often each of these texels should be judged; the mean is 1. Most of the error lies
/// where the lightmap has shadows' edges or noise, which may be one texel in a hundred. So a third
/// are chosen alike, a third by contrast and a third by its square.
std::vector<double> densities_of(const Image& lightmap, const TexelMap& texels,
                                 const std::vector<bool>& covered,
                                 std::span<const std::size_t> shown) {
    std::vector<double> contrast, densities;
    double sum = 0, squares = 0;
    for (const std::size_t texel : shown) {
        contrast.push_back(contrast_at(lightmap, texels, covered, texel));
        sum += contrast.back();
        squares += contrast.back() * contrast.back();
    }
    const double count = double(shown.size());
    if (!(squares > 0) || !std::isfinite(squares))
        return std::vector<double>(shown.size(), 1);
    for (const double own : contrast)
        densities.push_back((1 + count * own / sum + count * own * own / squares) / 3);
    return densities;
}

std::vector<JudgedPixel> judged_texels(const Mesh& mesh, const TexelMap& texels,
                                       const std::vector<bool>& covered, Bake bake,
                                       std::size_t count, const Image& lightmap,
                                       std::uint64_t seed) {
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && !covered[k])
            shown.push_back(k);
    const std::vector<double> densities = densities_of(lightmap, texels, covered, shown);
    Rng rng(seed);
    std::vector<JudgedPixel> judged;
    const double each = std::max(1.0, double(shown.size()) / double(count));
    double begun = 0, next = rng.uniform() * each, passed = 0;
    for (std::size_t k = 0; k < shown.size(); ++k) {
        for (passed += densities[k]; next < passed; next = begun + rng.uniform() * each) {
            begun += each;
            const SurfacePoint at = texels.point(shown[k]);
            Colours colours{Vec3(1.0), Vec3(0.0)};
            if (bake == Bake::radiosity)
                colours = colours_at(mesh, mesh.patches()[at.patch], at.position);
            if (colours.reflectance != Vec3(0.0))
                judged.push_back(
                    {shown[k], {{texels.receiver(shown[k]), colours}}, 1 / densities[k]});
        }
    }
    return judged;
}

} // namespace

std::vector<TargetPart> lightmap_parts(const Mesh& mesh, const TexelMap& texels,
                                       const std::vector<bool>& covered, Bake bake,
                                       std::uint64_t seed) {
    constexpr double parts = 512;
    constexpr int places = 16;
    constexpr double reach = 4; // [texels]
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && texels.is_inside(k) && !covered[k] &&
            (bake != Bake::radiosity ||
             mesh.material(texels.point(k).patch).reflectance != Vec3(0.0)))
            shown.push_back(k);
    std::vector<TargetPart> all;
    const double each = std::max(1.0, double(shown.size()) / parts);
    const auto size = static_cast<std::size_t>(texels.size());
    for (double next = 0; next < double(shown.size()); next += each) {
        Rng rng(hash_words({seed, all.size()}));
        const std::size_t first = shown[std::min(
            static_cast<std::size_t>(next + rng.uniform() * each), shown.size() - 1)];
        const SurfacePoint middle = texels.point(first);
        TargetPart& part = all.emplace_back();
        for (int k = 0; k < places; ++k) {
            const double dx = rng.uniform() - .5, dy = rng.uniform() - .5;
            const int x = static_cast<int>(first % size) + (k > 0 ? int(2 * reach * dx) : 0),
                      y = static_cast<int>(first / size) + (k > 0 ? int(2 * reach * dy) : 0);
            if (x < 0 || y < 0 || x >= texels.size() || y >= texels.size())
                continue;
            const std::size_t texel = texels.index(x, y);
            if (!texels.shows(texel) || covered[texel])
                continue;
            const SurfacePoint at = texels.point(texel);
            if (at.facet != middle.facet || at.normal != middle.normal)
                continue;
            part.points.push_back(at);
            part.reflectance.push_back(factor_of(mesh, at, bake));
        }
    }
    return all;
}

PictureJudge judge_of_lightmaps(const Mesh& mesh, const Tracer& tracer, const SurfaceLight& light,
                                const TexelMap& texels, const std::vector<bool>& covered, Bake bake,
                                std::uint64_t seed) {
    // Where few texels hold the error, its spread is hardly known itself.
    constexpr double sigmas_of_bound = 2;
    return {mesh,
            tracer,
            light,
            [&mesh, &texels, &covered, bake](std::size_t count, const Image& lightmap,
                                             std::uint64_t of) {
                return judged_texels(mesh, texels, covered, bake, count, lightmap, of);
            },
            seed,
            bake == Bake::indirect,
            sigmas_of_bound};
}

} // namespace hemilux
