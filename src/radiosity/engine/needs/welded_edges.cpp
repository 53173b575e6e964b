#include "radiosity/engine/needs/welded_edges.h"

#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

namespace hemilux {
namespace {

/// Returns for each vertex the number of the first one at its position.
std::vector<std::uint32_t> first_in_place(std::span<const Vec3> vertices) {
    std::unordered_map<Vec3, std::uint32_t, PositionHash> first;
    first.reserve(vertices.size());
    std::vector<std::uint32_t> welded;
    welded.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        welded.push_back(first.try_emplace(vertices[v], v).first->second);
    return welded;
}

} // namespace

std::size_t PositionHash::operator()(const Vec3& p) const {
    const auto word = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // -0 is 0
    return mix_bits(mix_bits(mix_bits(word(p.x)) + word(p.y)) + word(p.z));
}

std::vector<Edge> edges_of(std::span<const FacetCorners> facets,
                           std::span<const std::uint32_t> first) {
    std::vector<Edge> edges;
    edges.reserve(4 * facets.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint64_t a = first[facets[f][i]], b = first[facets[f][(i + 1) % 4]];
            if (a != b)
                edges.push_back({std::min(a, b) << 32 | std::max(a, b), f, a < b});
        }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.ends, e.facet); });
    return edges;
}

std::vector<Edge> welded_edges(const Scene& scene) {
    std::vector<FacetCorners> facets;
    facets.reserve(scene.facets.size());
    for (const Facet& facet : scene.facets)
        facets.push_back(facet.vertex);
    return edges_of(facets, first_in_place(scene.vertices));
}

EdgeCounts count_edges(const Scene& scene) {
    EdgeCounts counts;
    for_each_place(welded_edges(scene), [&](auto first, auto last) {
        counts.open += last - first == 1;
        counts.nonmanifold += last - first > 2;
    });
    return counts;
}

} // namespace hemilux
