#include "io/welded_edges.h"

#include "radiosity/rng.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace hemilux {
namespace {

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        const auto word = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // -0 is 0
        return hash_words({word(p.x), word(p.y), word(p.z)});
    }
};

/// For each vertex the first one at its position.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices) {
    std::unordered_map<Vec3, std::uint32_t, PositionHash> first;
    first.reserve(vertices.size());
    std::vector<std::uint32_t> welded;
    welded.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        welded.push_back(first.try_emplace(vertices[v], v).first->second);
    return welded;
}

/// Each facet's edges as pairs of welded vertices, the smaller one in the upper half.
std::vector<std::uint64_t> edges_of(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld(scene.vertices);
    std::vector<std::uint64_t> edges;
    edges.reserve(4 * scene.facets.size());
    for (const Facet& facet : scene.facets)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint64_t a = welded[facet.vertex[i]], b = welded[facet.vertex[(i + 1) % 4]];
            if (a != b)
                edges.push_back(std::min(a, b) << 32 | std::max(a, b));
        }
    return edges;
}

} // namespace

EdgeCounts count_edges(const Scene& scene) {
    std::vector<std::uint64_t> edges = edges_of(scene);
    std::sort(edges.begin(), edges.end());
    EdgeCounts counts;
    for (auto begin = edges.begin(); begin != edges.end();) {
        const auto end =
            std::find_if(begin, edges.end(), [&](auto edge) { return edge != *begin; });
        counts.open += end - begin == 1;
        counts.nonmanifold += end - begin > 2;
        begin = end;
    }
    return counts;
}

} // namespace hemilux
