#pragma once
// Describes how a texture lies on the faces of a material.

#include "radiosity/light/textures/texture.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace hemilux {

/// The texture coordinates of a facet's corners.
using Texcoords = std::array<glm::vec2, 4>;

/// The colour at a place is `factor` times the texel at origin + u x + v y, which counts from the
/// upper left corner of the picture.
struct TextureMap {
    std::shared_ptr<const Texture> texture; ///< none: the factor alone
    Wraps wraps;
    std::uint32_t set = 0; ///< of texture coordinates
    Vec2 origin{0.0}, x{1, 0}, y{0, 1};
    Vec3 factor{1.0};

    [[nodiscard]] Vec2 place(const Vec2& uv) const { return origin + uv.x * x + uv.y * y; }
};

struct MaterialTextures {
    TextureMap reflectance, emission;
    [[nodiscard]] bool any() const { return reflectance.texture || emission.texture; }
};

/// The textures that the faces of a scene carry.
struct SceneTextures {
    std::vector<MaterialTextures> of_material;     ///< empty: no texture at all
    std::vector<std::vector<Texcoords>> texcoords; ///< by set and facet

    [[nodiscard]] bool on(std::uint32_t material) const {
        return material < of_material.size() && of_material[material].any();
    }
};

} // namespace hemilux
