#include "radiosity/scene/welded_edges.h"

#include "radiosity/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <span>

namespace hemilux {
namespace {

std::uint64_t hash_of(const Vec3& p) {
    const auto word = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // -0 is 0
    return mix_bits(mix_bits(mix_bits(word(p.x)) + word(p.y)) + word(p.z));
}

/// For each vertex the first one at its position, by a hash table with linear probing.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices) {
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> table(std::bit_ceil(2 * vertices.size() + 1), none);
    std::vector<std::uint32_t> welded;
    welded.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        std::size_t slot = hash_of(vertices[v]) & (table.size() - 1);
        while (table[slot] != none && vertices[table[slot]] != vertices[v])
            slot = (slot + 1) & (table.size() - 1);
        if (table[slot] == none)
            table[slot] = v;
        welded.push_back(table[slot]);
    }
    return welded;
}

/// Calls visit(edge) for each side of a facet that has a length.
template <class Visit>
void for_each_edge(const Scene& scene, const std::vector<std::uint32_t>& welded,
                   const Visit& visit) {
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& vertex = scene.facets[f].vertex;
            const std::uint64_t a = welded[vertex[i]], b = welded[vertex[(i + 1) % 4]];
            if (a != b)
                visit(Edge{std::min(a, b) << 32 | std::max(a, b), f, a < b});
        }
}

} // namespace

/// A counting sort by the smaller vertex, of which most have few edges, then within each.
std::vector<Edge> welded_edges(const Scene& scene) {
    const std::vector<std::uint32_t> welded = weld(scene.vertices);
    std::vector<std::size_t> end(scene.vertices.size() + 1, 0);
    for_each_edge(scene, welded, [&](const Edge& e) { ++end[(e.ends >> 32) + 1]; });
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::vector<Edge> edges(end.back());
    for_each_edge(scene, welded, [&](const Edge& e) { edges[end[e.ends >> 32]++] = e; });
    std::size_t begin = 0;
    for (const std::size_t next : std::span(end).first(scene.vertices.size())) {
        std::sort(edges.begin() + static_cast<std::ptrdiff_t>(begin),
                  edges.begin() + static_cast<std::ptrdiff_t>(next),
                  [](const Edge& a, const Edge& b) {
                      return a.ends != b.ends ? a.ends < b.ends : a.facet < b.facet;
                  });
        begin = next;
    }
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
