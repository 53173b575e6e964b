#include "radiosity/welded_edges.h"

#include "radiosity/rng.h"

#include <algorithm>
#include <bit>
#include <tuple>
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

} // namespace

std::vector<Edge> welded_edges(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld(scene.vertices);
    std::vector<Edge> edges;
    edges.reserve(4 * scene.facets.size());
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& vertex = scene.facets[f].vertex;
            const std::uint64_t a = welded[vertex[i]], b = welded[vertex[(i + 1) % 4]];
            if (a != b)
                edges.push_back({std::min(a, b) << 32 | std::max(a, b), f, a < b});
        }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.ends, e.facet); });
    return edges;
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
