#pragma once
// Wavefront material libraries (MTL), as far as they are about light. Kd is the reflectance and Ke
// the emission. Of all else it is kept whether it makes a surface one that is not diffuse here.

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

/// The name of a material whose newmtl has none, as of faces that name none.
inline constexpr const char* unnamed_material = "default";

struct MtlMaterial {
    std::string name;
    std::size_t line = 0;            ///< line of its newmtl
    std::optional<Vec3> reflectance; ///< Kd, each channel >= 0 and possibly 1 or more
    std::optional<Vec3> emission;    ///< Ke, each channel >= 0 [W/m2]
    std::optional<MtlTexture> reflectance_map, emission_map; ///< map_Kd, map_Ke
    /// The statement by which the surface lets light through (d, Tr, illum 6 and 7), that by which
    /// it has holes (map_d), and that by which it is a mirror or a metal (illum 3 and 5, Pm);
    /// empty: there is none.
    std::string transparent, cut_out, mirror;
    bool has_opacity = false; ///< by d
    double opacity = 1;       ///< d, or 1 - Tr where there is no d [-]
    Vec3 filter{1.0};         ///< Tf [-]

    /// Returns the share of light that comes through, within [0,1]: the filter times what is not
    /// opaque. By illum 6 or 7 all else is clear where there is no d or Tr below 1.
    [[nodiscard]] Vec3 transmittance() const;
};

struct MtlFile {
    std::vector<MtlMaterial> materials; ///< materials as in the file, also with equal names
    /// Names of the files that it refers to, each once. After options such as `-s 2 2 1` every tail
    /// of the line counts as a name, as only some options have a known number of words.
    std::vector<std::string> textures;
    std::vector<std::string> warnings; ///< "line: ..." of statements that are passed over
};

/// Reads a library. Throws InputError.
[[nodiscard]] MtlFile read_mtl(const std::string& path);

} // namespace hemilux
