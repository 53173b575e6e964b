#include "radiosity/answers/lightmaps/lightmap_layout.h"

#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"

#include <map>
#include <utility>

namespace hemilux {

TexelMap texels_of(const LightmapLayout& layout, std::vector<PlacedTriangle> triangles,
                   const Mesh& mesh, const Tracer& tracer) {
    TexelMap texels(mesh, std::move(triangles), layout.size);
    if (!layout.normals.empty())
        texels.set_normals(layout.normals, tracer);
    return texels;
}

void show_brighter_sides(const Mesh& mesh, const Solution& solution,
                         std::vector<PlacedTriangle>& triangles) {
    const Scene& scene = mesh.scene();
    std::vector<double> of_side(2 * scene.facets.size()); // light by facet and side
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Patch& patch = mesh.patches()[i];
        const Vec3 light = solution.radiosity[i] - mesh.material(patch).emission;
        of_side[2 * std::size_t{patch.facet} + (patch.back ? 1 : 0)] +=
            patch.area * (light.x + light.y + light.z);
    }
    std::map<std::uint32_t, double> more_behind; // by chart
    for (const PlacedTriangle& triangle : triangles)
        if (mesh.has_back(triangle.facet) && !triangle.second_half)
            more_behind[triangle.chart] += of_side[2 * std::size_t{triangle.facet} + 1] -
                                           of_side[2 * std::size_t{triangle.facet}];
    for (PlacedTriangle& triangle : triangles)
        if (const auto found = more_behind.find(triangle.chart); found != more_behind.end())
            triangle.back = mesh.has_back(triangle.facet) && found->second > 0;
}

} // namespace hemilux
