#include "radiosity/light/textures/scene_textures.h"

#include "parallel/workers.h"
#include "radiosity/light/textures/textured_facets.h"
#include "radiosity/paper/scene/mesh.h"

#include <memory>

namespace hemilux {

std::vector<Colours> SceneTextures::means(const Mesh& mesh, std::span<const std::uint32_t> patches,
                                          unsigned threads) const {
    std::vector<Colours> means(patches.size());
    Workers(threads).for_chunks(means.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Patch& patch = mesh.patches()[patches[k]];
            means[k] =
                mean_colours(mesh.scene(), patch.facet, mesh.shape_of(patch.facet), patch.shape);
        }
    });
    return means;
}

Colours SceneTextures::at(const Mesh& mesh, const Patch& patch, const Vec3& point) const {
    return colours_at_point(mesh.scene(), patch.facet, mesh.shape_of(patch.facet), point);
}

const SceneTextures& textures_of(const Scene& scene) {
    static const SceneTextures no_textures;
    const auto* textures = dynamic_cast<const SceneTextures*>(scene.varying.get());
    return textures ? *textures : no_textures;
}

SceneTextures& own_textures_of(Scene& scene) {
    if (!scene.varying || scene.varying.use_count() > 1)
        scene.varying = std::make_shared<SceneTextures>(textures_of(scene));
    return dynamic_cast<SceneTextures&>(*scene.varying);
}

} // namespace hemilux
