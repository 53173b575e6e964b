#include "radiosity/scene/convex_enclosure.h"

#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <span>
#include <tuple>
#include <vector>

namespace hemilux {
namespace {

/// How far a vertex may lie behind a wall's plane, in local units: decimals in files.
constexpr double slack = 1e-7;
/// Pairs of planes and vertices that are looked at.
constexpr double most_pairs = 1e8;

/// normal . x = offset
struct Plane {
    Vec3 normal;
    double offset;
};

/// Planes of almost the same numbers are one.
using PlaneKey = std::array<long long, 4>;
PlaneKey key_of(const Plane& plane) {
    constexpr double grid = 1e9;
    return {std::llround(grid * plane.normal.x), std::llround(grid * plane.normal.y),
            std::llround(grid * plane.normal.z), std::llround(grid * plane.offset)};
}

std::vector<Vec3> points_in_use(const FacetSoup& soup) {
    std::vector<bool> used(soup.vertices.size());
    for (const FacetCorners& corners : soup.facets)
        for (const std::uint32_t v : corners)
            used[v] = true;
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v])
            points.push_back(soup.vertices[v]);
    return points;
}

Plane plane_of(const FacetSoup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const Vec3& p = soup.vertices[a];
    const Vec3 n = glm::normalize(glm::cross(soup.vertices[b] - p, soup.vertices[c] - p));
    return {n, glm::dot(n, p)};
}

/// Both halves of a quad have their say, as one that is not quite planar needs.
bool all_in_front(const FacetSoup& soup) {
    const std::vector<Vec3> points = points_in_use(soup);
    std::set<PlaneKey> seen;
    const auto check = [&](const Plane& plane) {
        if (!seen.insert(key_of(plane)).second)
            return true;
        return static_cast<double>(seen.size()) * static_cast<double>(points.size()) <=
                   most_pairs &&
               std::ranges::all_of(points, [&](const Vec3& p) {
                   return glm::dot(plane.normal, p) - plane.offset >= -slack;
               });
    };
    return std::ranges::all_of(soup.facets, [&](const FacetCorners& v) {
        return check(plane_of(soup, v[0], v[1], v[2])) &&
               (v[2] == v[3] || check(plane_of(soup, v[0], v[2], v[3])));
    });
}

/// For each vertex a number that it shares with those at its position.
std::vector<std::uint32_t> weld(std::span<const Vec3> vertices) {
    std::vector<std::uint32_t> order(vertices.size()), welded(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t v) {
        return std::tie(vertices[v].x, vertices[v].y, vertices[v].z);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && vertices[order[k]] == vertices[order[k - 1]];
        welded[order[k]] = same ? welded[order[k - 1]] : order[k];
    }
    return welded;
}

/// Each directed edge once, and its opposite once.
bool is_closed(const FacetSoup& soup) {
    const std::vector<std::uint32_t> welded = weld(soup.vertices);
    std::vector<std::uint64_t> edges;
    for (const FacetCorners& corners : soup.facets)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint64_t a = welded[corners[i]], b = welded[corners[(i + 1) % 4]];
            if (a != b)
                edges.push_back(a << 32 | b);
        }
    std::ranges::sort(edges);
    if (std::ranges::adjacent_find(edges) != edges.end())
        return false;
    return std::ranges::all_of(edges, [&](std::uint64_t edge) {
        return std::ranges::binary_search(edges, edge << 32 | edge >> 32);
    });
}

} // namespace

bool is_convex_enclosure(const Mesh& mesh) {
    return all_in_front(mesh.soup()) && is_closed(mesh.soup());
}

} // namespace hemilux
