#include "radiosity/answers/lightmaps/file_places.h"

#include "radiosity/engine/sparse/disjoint_sets.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

namespace hemilux {
namespace {

void add_once(std::vector<std::uint32_t>& groups, std::uint32_t group) {
    if (std::ranges::find(groups, group) == groups.end())
        groups.push_back(group);
}

} // namespace

void PlacesOfFile::add(const PlacedTriangle& triangle, std::uint32_t group) {
    constexpr double rounding = 1e-5;
    const auto& place = triangle.place;
    if (cross(place[1] - place[0], place[2] - place[0]) == 0)
        add_without(group);
    if (!std::ranges::all_of(place, [](const Vec2& p) {
            return std::min(p.x, p.y) >= -rounding && std::max(p.x, p.y) <= 1 + rounding;
        }))
        add_once(outside, group);
    triangles.push_back(triangle);
}

void PlacesOfFile::add_without(std::uint32_t group) { add_once(without, group); }

void PlacesOfFile::join_charts(const Mesh& mesh) {
    using End = std::tuple<double, double, double, double, double>;
    std::map<End, std::uint32_t> at;
    DisjointSets joined(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const auto corners = corners_of(mesh, triangles[t]);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Vec2& place = triangles[t].place[k];
            const auto [found, is_new] =
                at.try_emplace(End(place.x, place.y, corners[k].x, corners[k].y, corners[k].z), t);
            if (!is_new)
                joined.join(found->second, t);
        }
    }
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        triangles[t].chart = joined.find(t);
}

} // namespace hemilux
