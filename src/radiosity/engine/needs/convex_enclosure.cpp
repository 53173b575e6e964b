#include "radiosity/engine/needs/convex_enclosure.h"

#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
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

/// Returns whether each edge belongs to two facets that run along it in opposite directions.
bool is_closed(const Scene& scene) {
    bool closed = true;
    for_each_place(welded_edges(scene), [&](auto first, auto last) {
        closed = closed && last - first == 2 && first[0].forward != first[1].forward;
    });
    return closed;
}

} // namespace

bool is_convex_enclosure(const Mesh& mesh) {
    return all_in_front(mesh.soup()) && is_closed(mesh.scene());
}

} // namespace hemilux
