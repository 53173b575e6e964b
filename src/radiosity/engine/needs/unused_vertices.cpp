#include "radiosity/engine/needs/unused_vertices.h"

#include "radiosity/paper/scene/scene.h"

#include <algorithm>
#include <functional>

namespace hemilux {

void drop_unused_vertices(Scene& scene) {
    std::vector<bool> used(scene.vertices.size());
    for (const Facet& facet : scene.facets)
        for (const std::uint32_t v : facet.vertex)
            used[v] = true;
    if (std::ranges::all_of(used, std::identity{}))
        return;
    std::vector<std::uint32_t> number(scene.vertices.size());
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) {
            scene.vertices[kept] = scene.vertices[v];
            number[v] = kept++;
        }
    scene.vertices.resize(kept);
    scene.vertices.shrink_to_fit();
    for (Facet& facet : scene.facets)
        for (std::uint32_t& v : facet.vertex)
            v = number[v];
}

} // namespace hemilux
