#pragma once
// The figures of a scene, and what is doubtful about it.

#include "geometry/box.h"
#include "io/scene_files/read_result.h"
#include "radiosity/engine/solving/left_out.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// A material that is used and emits.
struct EmitterInfo {
    std::string name;
    Vec3 emission{0.0};      ///< [W/m2], the mean of textures
    Vec3 power{0.0};         ///< of all its faces, both sides [W]
    bool both_sides = false; ///< some of its faces shine to both sides
};

/// A light without extent.
struct PointInfo {
    std::string name;
    std::string kind; ///< point, spot or measured lamp
    Vec3 intensity;   ///< on its axis [W/sr]
    Vec3 power;       ///< [W]
};

/// A material that lets light through.
struct GlassInfo {
    std::string name;
    Vec3 transmittance{0.0}; ///< [-], of light that crosses a face of it once
    bool open = false;       ///< else it is opaque here
};

struct SceneInfo {
    std::size_t faces = 0;                            ///< faces in the file
    std::size_t facets = 0, triangles = 0, quads = 0; ///< made of them
    std::size_t vertices = 0, materials = 0, groups = 0;
    Box bounds;              ///< box of the facets [m]
    double total_area = 0;   ///< area of the front sides [m2]
    Vec3 emitted_power{0.0}; ///< sum of E A, and that of lights without extent [W per channel]

    /// Edges of exactly one facet, and those of three or more, vertices at equal positions being
    /// one. A closed scene has no open edges, unless vertices lie on edges of other facets.
    std::size_t open_edges = 0, nonmanifold_edges = 0;
    std::size_t covered_facets = 0; ///< coplanar_layers.h
    bool all_compared = true;       ///< else some more may be covered
    std::size_t degenerate_faces = 0, nonplanar_faces = 0, concave_faces = 0;

    std::vector<EmitterInfo> emitters;
    std::vector<PointInfo> points;
    std::vector<GlassInfo> glass;
    std::vector<std::string> bad_reflectances;
};

[[nodiscard]] SceneInfo inspect(const ReadResult& read);

/// Returns a message for each material in use whose reflectance is outside [0,1]. It has the name,
/// the value and, as far as known, where the material is defined. No solution exists with such
/// materials.
[[nodiscard]] std::vector<std::string> find_bad_reflectances(const ReadResult& read);

/// The column from which on a line of a report has its value; the name is on the left.
inline constexpr std::size_t info_value_column = 20;
[[nodiscard]] std::string info_line(std::string name, const std::string& value);

/// Returns lines of text: names on the left, figures on the right.
[[nodiscard]] std::string describe(const SceneInfo& info);
/// Returns what the scene does not need in the same form, a line each; empty if it needs
/// everything.
[[nodiscard]] std::string describe(std::span<const LeftOut> left_out);

} // namespace hemilux
