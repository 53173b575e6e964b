#pragma once
// Holds the textures that the faces of a scene carry, and gives the mesh their means over patches.

#include "radiosity/light/textures/texture_map.h"
#include "radiosity/paper/scene/scene.h"
#include "radiosity/paper/scene/varying_colours.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace hemilux {

struct MaterialTextures {
    TextureMap reflectance, emission;
    bool tinted = false; ///< the emission is multiplied by SceneTextures::tints
    [[nodiscard]] bool any() const { return reflectance.texture || emission.texture; }
};

/// Factors of the emission at the corners of a facet [-], linear on either half.
using Tints = std::array<glm::vec3, 4>;

/// A textured material has the colours of its textures' means.
struct SceneTextures final : VaryingColours {
    std::vector<MaterialTextures> of_material;     ///< empty: no texture at all
    std::vector<std::vector<Texcoords>> texcoords; ///< by set and facet
    std::vector<Tints> tints;                      ///< by facet; empty: no material is tinted

    [[nodiscard]] bool has_texture(std::uint32_t material) const {
        return material < of_material.size() && of_material[material].any();
    }
    [[nodiscard]] bool on(std::uint32_t material) const override {
        return has_texture(material) || is_tinted(material);
    }
    [[nodiscard]] bool emission_on(std::uint32_t material) const override {
        return is_tinted(material) ||
               (has_texture(material) && of_material[material].emission.texture);
    }
    [[nodiscard]] bool is_tinted(std::uint32_t material) const {
        return material < of_material.size() && of_material[material].tinted;
    }
    [[nodiscard]] std::vector<Colours> means(const Mesh& mesh,
                                             std::span<const std::uint32_t> patches,
                                             unsigned threads) const override;
    [[nodiscard]] Colours at(const Mesh& mesh, const Patch& patch,
                             const Vec3& point) const override;
};

/// Returns the textures of a scene; none where it has no textures.
[[nodiscard]] const SceneTextures& textures_of(const Scene& scene);
/// Returns the textures of a scene to be changed, which no copy of the scene shares.
[[nodiscard]] SceneTextures& own_textures_of(Scene& scene);

} // namespace hemilux
