#include "radiosity/engine/needs/convex_enclosure.h"

#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/engine/rays/panes.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// The largest distance [local units] of a vertex behind a wall's plane, as coordinates in files
/// are rounded to decimals.
constexpr double slack = 1e-7;
/// The largest number of pairs of a plane and a vertex that are tested.
constexpr double max_pairs = 1e8;

/// A plane with the equation normal . x = offset.
struct Plane {
    Vec3 normal;
    double offset;
};

/// Planes of almost the same numbers share a key.
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

/// Returns whether all points lie in front of every plane. Both halves of a quad are tested, as it
/// may be not quite planar.
bool all_in_front(const FacetSoup& soup) {
    const std::vector<Vec3> points = points_in_use(soup);
    std::set<PlaneKey> seen;
    const auto check = [&](const Plane& plane) {
        if (!seen.insert(key_of(plane)).second)
            return true;
        return static_cast<double>(seen.size()) * static_cast<double>(points.size()) <= max_pairs &&
               std::ranges::all_of(points, [&](const Vec3& p) {
                   return glm::dot(plane.normal, p) - plane.offset >= -slack;
               });
    };
    return std::ranges::all_of(soup.facets, [&](const FacetCorners& v) {
        return check(plane_of(soup, v[0], v[1], v[2])) &&
               (v[2] == v[3] || check(plane_of(soup, v[0], v[2], v[3])));
    });
}

/// Returns whether two facets and no more run along an edge, in opposite directions.
template <class Iterator>
bool is_shared(Iterator first, Iterator last) {
    return last - first == 2 && first[0].forward != first[1].forward;
}

/// Returns the edges that do not belong to two facets that run along them in opposite directions.
std::vector<Edge> unshared(const std::vector<Edge>& edges) {
    std::vector<Edge> alone;
    for_each_place(edges, [&](auto first, auto last) {
        if (!is_shared(first, last))
            alone.insert(alone.end(), first, last);
    });
    return alone;
}

std::array<std::uint32_t, 2> ends_of(const Edge& edge) {
    return {static_cast<std::uint32_t>(edge.ends >> 32), static_cast<std::uint32_t>(edge.ends)};
}

/// Cuts an edge at those of the vertices that lie between its ends, and appends the pieces.
void cut(const Edge& edge, std::span<const Vec3> position, std::span<const std::uint32_t> vertices,
         std::vector<Edge>& pieces) {
    const auto [a, b] = ends_of(edge);
    const Vec3 along = position[b] - position[a];
    const double length = glm::length(along);
    std::vector<std::pair<double, std::uint32_t>> stops{{0, a}, {1, b}};
    for (const std::uint32_t v : vertices) {
        const Vec3 to = position[v] - position[a];
        const double share = glm::dot(to, along) / (length * length);
        if (share > 0 && share < 1 && v != a && v != b && glm::length(to - share * along) <= slack)
            stops.emplace_back(share, v);
    }
    std::ranges::sort(stops);
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
        const std::uint64_t p = stops[k].second, q = stops[k + 1].second;
        pieces.push_back(
            {std::min(p, q) << 32 | std::max(p, q), edge.facet, edge.forward == (p < q)});
    }
}

/// Returns whether edges lie along each other when they are cut at each other's ends: each piece
/// then belongs to two of them in opposite directions.
bool match_in_pieces(const std::vector<Edge>& edges, const Mesh& mesh) {
    std::set<std::uint32_t> ends;
    for (const Edge& edge : edges)
        for (const std::uint32_t v : ends_of(edge))
            ends.insert(v);
    if (static_cast<double>(edges.size()) * static_cast<double>(ends.size()) > max_pairs)
        return false;
    const std::vector<std::uint32_t> vertices(ends.begin(), ends.end());
    std::vector<Vec3> position = mesh.scene().vertices;
    for (Vec3& p : position)
        p = mesh.frame().to_local(p);
    std::vector<Edge> pieces;
    for (const Edge& edge : edges)
        cut(edge, position, vertices, pieces);
    std::ranges::sort(pieces, {}, &Edge::ends);
    return unshared(pieces).empty();
}

} // namespace

Enclosure convex_enclosure(const Mesh& mesh) {
    if (!panes_of(mesh.scene()).empty() || !all_in_front(mesh.soup()))
        return Enclosure::not_found;
    const std::vector<Edge> alone = unshared(welded_edges(mesh.scene()));
    if (alone.empty())
        return Enclosure::tight;
    return match_in_pieces(alone, mesh) ? Enclosure::cut_edges : Enclosure::not_found;
}

} // namespace hemilux
