#include "radiosity/light/layers/layered_mesh.h"

#include "radiosity/light/layers/coplanar_layers.h"

#include <utility>

namespace hemilux {
namespace {

void offset_layers(const CoplanarLayers& layers, LocalFacets& facets) {
    constexpr double step = 0x1p-28; // larger than what is taken for rounding elsewhere
    for (std::uint32_t f = 0; f < layers.offset.size(); ++f) {
        const Polygon shape = facets.shape_of(f);
        if (layers.offset[f] == 0 || !(shape.area() > 0))
            continue;
        const bool triangle = shape.is_triangle();
        const Vec3 way = layers.offset[f] * step * shape.normal();
        const auto first = static_cast<std::uint32_t>(facets.vertices.size());
        for (const Vec3& corner : shape.corner)
            facets.vertices.push_back(corner + way);
        facets.corners[f] = {first, first + 1, first + 2, first + (triangle ? 2 : 3)};
    }
    facets.all_layers_are_offset = layers.complete;
    if (!layers.buried.empty())
        facets.corners_to_trace = facets.corners;
    for (const std::uint32_t f : layers.buried)
        facets.corners_to_trace[f].fill(facets.corners[f][0]);
}

} // namespace

Mesh layered_mesh(Scene scene, const MeshOptions& options) {
    LocalFacets facets(scene);
    unite_near_twins(scene, facets.vertices);
    for (std::size_t f = 0; f < scene.facets.size(); ++f)
        facets.corners[f] = scene.facets[f].vertex;
    offset_layers(find_coplanar_layers(scene, facets.vertices), facets);
    return {std::move(scene), options, std::move(facets)};
}

} // namespace hemilux
