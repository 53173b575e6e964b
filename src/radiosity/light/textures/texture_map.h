#pragma once
// Describes how a texture lies on the faces of a material.

#include "radiosity/light/textures/texture.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <memory>

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

} // namespace hemilux
