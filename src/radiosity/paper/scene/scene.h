#pragma once
// Describes what a file holds: polygons with materials and groups, in the user's own units.

#include "geometry/vector.h"
#include "radiosity/paper/scene/varying_colours.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hemilux {

struct PointEmitter; // a light without extent (radiosity/engine/rays)
struct Pane;         // a face that lets light through (radiosity/engine/rays)

/// A diffuse surface. Colours have three channels: red, green, blue.
struct Material {
    std::string name;
    Vec3 reflectance{0.5}; ///< rho [-], each channel in [0,1]; 1 only where light gets out
    Vec3 emission{0.0};    ///< E [W/m2 leaving]
    bool is_far = false;   ///< a sun or a sky, left out of the size of the scene
};

/// A triangle or a planar convex quad of the scene: a file's face or a part of one.
struct Facet {
    std::array<std::uint32_t, 4> vertex; ///< counter-clockwise from the front; triangle: [3] == [2]
    std::uint32_t face;                  ///< 0-based index of the face in the file
    std::uint32_t material;
    std::uint32_t group;
    bool two_sided = false; ///< its back emits and reflects too

    [[nodiscard]] bool is_triangle() const { return vertex[2] == vertex[3]; }
};

struct Scene {
    std::vector<Vec3> vertices; ///< world units [m]
    std::vector<Facet> facets;
    std::vector<Material> materials;
    std::vector<std::string> groups;
    std::uint32_t faces = 0; ///< faces in the file, including those without area
    /// The colours of materials that vary over their facets, such as textures. The Material has
    /// their means. It is empty where none varies; copies of a scene share it.
    std::shared_ptr<VaryingColours> varying = {};
    /// Lights without extent; it is empty where there are none. Copies of a scene share them.
    std::shared_ptr<const std::vector<PointEmitter>> point_emitters = {};
    /// Faces that dim light and do nothing else, so they are no facets; empty, and shared, as
    /// above.
    std::shared_ptr<const std::vector<Pane>> panes = {};

    [[nodiscard]] bool colours_vary_on(std::uint32_t material) const {
        return varying && varying->on(material);
    }
};

/// Returns, by material, whether some facet is made of it.
[[nodiscard]] inline std::vector<bool> materials_in_use(const Scene& scene) {
    std::vector<bool> used(scene.materials.size());
    for (const Facet& facet : scene.facets)
        used[facet.material] = true;
    return used;
}

} // namespace hemilux
