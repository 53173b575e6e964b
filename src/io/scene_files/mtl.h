#pragma once
// Wavefront material libraries (MTL), as far as they are about light. Kd is the reflectance and Ke
// the emission; all other statements are passed over, wherever they stand.

#include "geometry/vector.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hemilux {

/// A texture with its options; the place on the picture is offset + scale times the coordinates.
struct MtlTexture {
    std::string name;
    Vec2 scale{1.0}, offset{0.0};
    bool clamp = false;
};

struct MtlMaterial {
    std::string name;
    std::size_t line = 0;            ///< line of its newmtl
    std::optional<Vec3> reflectance; ///< Kd, each channel >= 0 and possibly 1 or more
    std::optional<Vec3> emission;    ///< Ke, each channel >= 0 [W/m2]
    std::optional<MtlTexture> reflectance_map, emission_map; ///< map_Kd, map_Ke
};

struct MtlFile {
    std::vector<MtlMaterial> materials; ///< materials as in the file, also with equal names
    /// Names of the files that it refers to, each once. After options such as `-s 2 2 1` every tail
    /// of the line counts as a name, as only some options have a known number of words.
    std::vector<std::string> textures;
};

/// Reads a library. Throws InputError.
[[nodiscard]] MtlFile read_mtl(const std::string& path);

} // namespace hemilux
