#include "radiosity/engine/rays/make_tracer.h"

#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/rays/tracer_with_panes.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

/// Finds the mean over some of the facets, at equal distances in their list.
Crowd find_crowd(const Mesh& mesh, const WideBvh& tree) {
    constexpr std::uint32_t max_facets = 512;
    const auto facets = static_cast<std::uint32_t>(mesh.soup().facets.size());
    const std::uint32_t asked = std::min(facets, max_facets);
    Crowd crowd;
    std::size_t sum = 0, most = 0;
    for (std::uint32_t k = 0; k < asked; ++k) {
        const auto f = static_cast<std::uint32_t>(std::uint64_t{k} * facets / asked);
        const std::size_t around = tree.triangles_around(mesh.shape_of(f).centre());
        sum += around;
        if (around > most) {
            most = around;
            crowd.facet = f;
        }
    }
    crowd.triangles = asked > 0 ? sum / asked : 0;
    return crowd;
}

std::unique_ptr<Tracer> with_panes(std::unique_ptr<Tracer> facets, const Mesh& mesh) {
    if (panes_of(mesh.scene()).empty())
        return facets;
    return std::make_unique<TracerWithPanes>(std::move(facets), mesh);
}

} // namespace

MadeTracer make_tracer(const Mesh& mesh, unsigned threads) {
    auto tracer =
        std::make_unique<WideBvh>(mesh.soup_to_trace(), WideBvhOptions{.threads = threads});
    const BvhQuality quality = tracer->quality();
    const Crowd crowd = find_crowd(mesh, *tracer);
    return {with_panes(std::move(tracer), mesh), quality, crowd};
}

} // namespace hemilux
