#include "radiosity/engine/needs/unused_vertices.h"

#include "radiosity/paper/scene/scene.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace hemilux {

void drop_unused_vertices(Scene& scene) {
    std::vector<bool> used(scene.vertices.size());
    for (const Facet& facet : scene.facets)
        for (const std::uint32_t v : facet.vertex)
            used[v] = true;
    if (std::ranges::all_of(used, std::identity{}))
        return;
    std::vector<std::uint32_t> number(scene.vertices.size()), read_as;
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < used.size(); ++v)
        if (used[v]) {
            scene.vertices[kept] = scene.vertices[v];
            read_as.push_back(scene.number_read(v));
            number[v] = kept++;
        }
    scene.read_as = std::move(read_as);
    scene.vertices.resize(kept);
    scene.vertices.shrink_to_fit();
    for (Facet& facet : scene.facets)
        for (std::uint32_t& v : facet.vertex)
            v = number[v];
}

} // namespace hemilux
