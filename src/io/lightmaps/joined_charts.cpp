#include "io/lightmaps/joined_charts.h"

#include "radiosity/engine/sparse/disjoint_sets.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

namespace hemilux {

void join_charts(const Mesh& mesh, std::vector<PlacedTriangle>& triangles) {
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
