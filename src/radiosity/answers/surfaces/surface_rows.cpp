#include "radiosity/answers/surfaces/surface_rows.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <map>

namespace hemilux {
namespace {

/// Keeps a text that all parts of a surface share.
void share(std::string& text, const std::string& of_part, bool is_first) {
    if (is_first)
        text = of_part;
    else if (text != of_part)
        text.clear();
}

} // namespace

std::optional<std::uint32_t> FactorSurfaces::row_named(const std::string& name) const {
    const auto found = std::ranges::find(rows, name, &FactorSurface::name);
    return found == rows.end() ? std::nullopt
                               : std::optional(static_cast<std::uint32_t>(found - rows.begin()));
}

FactorSurfaces factor_surfaces(const Mesh& mesh, FactorRows by) {
    const Scene& scene = mesh.scene();
    const auto key_of = [&](const Patch& patch) -> std::uint64_t {
        if (by == FactorRows::patch)
            return static_cast<std::uint64_t>(&patch - mesh.patches().data());
        const Facet& facet = scene.facets[patch.facet];
        if (by == FactorRows::face)
            return std::uint64_t{2} * facet.face + (patch.back ? 1 : 0);
        return by == FactorRows::group ? facet.group : patch.material;
    };
    std::map<std::uint64_t, std::uint32_t> row_of_key;
    for (const Patch& patch : mesh.patches())
        row_of_key.emplace(key_of(patch), 0);
    FactorSurfaces surfaces;
    for (auto& [key, row] : row_of_key) {
        row = static_cast<std::uint32_t>(surfaces.rows.size());
        FactorSurface& surface = surfaces.rows.emplace_back();
        if (by == FactorRows::face)
            surface.name = std::to_string(key / 2) + (key % 2 != 0 ? " back" : "");
        else if (by == FactorRows::patch)
            surface.name = std::to_string(key);
        else
            surface.name = by == FactorRows::group ? scene.groups[key] : scene.materials[key].name;
    }
    for (const Patch& patch : mesh.patches()) {
        const std::uint32_t row = row_of_key.at(key_of(patch));
        surfaces.row_of.push_back(row);
        FactorSurface& surface = surfaces.rows[row];
        const Facet& facet = scene.facets[patch.facet];
        const bool is_first = !(surface.area > 0);
        share(surface.face, std::to_string(facet.face), is_first);
        share(surface.side, patch.back ? "back" : "front", is_first);
        share(surface.material, scene.materials[patch.material].name, is_first);
        share(surface.group, scene.groups[facet.group], is_first);
        const double area = mesh.frame().area_to_world(patch.area);
        surface.area += area;
        surface.centre += area * mesh.frame().to_world(patch.centre);
        surface.normal += area * patch.normal;
    }
    for (FactorSurface& surface : surfaces.rows) {
        surface.centre /= surface.area;
        const double length = glm::length(surface.normal);
        surface.normal = length > 1e-9 * surface.area ? surface.normal / length : Vec3(0.0);
    }
    return surfaces;
}

} // namespace hemilux
