#include "io/lightmaps/lightmap_target.h"

#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>

namespace hemilux {
namespace {

/// Returns what of the irradiance at a texel counts.
Vec3 factor_of(const Mesh& mesh, const SurfacePoint& at, Bake bake) {
    return bake == Bake::radiosity
               ? colours_at(mesh, mesh.patches()[at.patch], at.position).reflectance
               : Vec3(1.0);
}

std::vector<JudgedPixel> judged_texels(const Mesh& mesh, const TexelMap& texels,
                                       const std::vector<bool>& covered, Bake bake,
                                       std::size_t count, std::uint64_t seed) {
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.shows(k) && !covered[k] && texels.is_inside(k))
            shown.push_back(k);
    Rng rng(seed);
    std::vector<JudgedPixel> judged;
    const double each = std::max(1.0, double(shown.size()) / double(count));
    for (double next = 0; next < double(shown.size()); next += each) {
        const std::size_t texel = shown[std::min(
            static_cast<std::size_t>(next + rng.uniform() * each), shown.size() - 1)];
        const SurfacePoint at = texels.point(texel);
        Colours colours{Vec3(1.0), Vec3(0.0)};
        if (bake == Bake::radiosity)
            colours = colours_at(mesh, mesh.patches()[at.patch], at.position);
        if (colours.reflectance != Vec3(0.0))
            judged.push_back({texel, {{texels.receiver(texel), colours}}});
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
    return {mesh,
            tracer,
            light,
            [&mesh, &texels, &covered, bake](std::size_t count, std::uint64_t of) {
                return judged_texels(mesh, texels, covered, bake, count, of);
            },
            seed,
            bake == Bake::indirect};
}

} // namespace hemilux
