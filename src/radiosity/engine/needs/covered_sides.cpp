#include "radiosity/engine/needs/covered_sides.h"

#include "bvh/intersect.h"
#include "geometry/polygon.h"
#include "radiosity/engine/needs/facet_contact.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace hemilux {
namespace {

/// One side of a facet lies over another's, at least in part.
struct Over {
    FacetSide side, over;
    double distance; ///< local units
    bool whole;      ///< it lies over all of it
};

/// Describes how facet g lies over one of the sides of f.
Over over(const Mesh& mesh, std::span<const Polygon> in_place, std::uint32_t f, std::uint32_t g) {
    const Vec3 n = in_place[f].normal(), m = in_place[g].normal();
    const double height = glm::dot(n, mesh.shape_of(g).corner[0] - mesh.shape_of(f).corner[0]);
    const bool faces_front = (height > 0) == (glm::dot(n, m) < 0);
    return {2 * f + (height > 0 ? 0 : 1), 2 * g + (faces_front ? 0 : 1), std::abs(height),
            lies_within(in_place[f], in_place[g])};
}

std::vector<CoveredSide> covered_of(std::vector<Over>& all) {
    std::ranges::sort(all, {},
                      [](const Over& o) { return std::tuple(o.side, o.distance, o.over); });
    std::vector<CoveredSide> covered;
    for (auto first = all.begin(); first != all.end();) {
        const auto last =
            std::find_if(first, all.end(), [&](const Over& o) { return o.side != first->side; });
        const auto cover = std::find_if(first, last, [](const Over& o) { return o.whole; });
        if (cover != last) {
            covered.push_back({first->side, {}});
            for (auto o = first; o <= cover; ++o)
                covered.back().faces.push_back(o->over);
        }
        first = last;
    }
    return covered;
}

} // namespace

std::vector<CoveredSide> find_covered_sides(const Mesh& mesh) {
    const std::vector<Facet>& facets = mesh.scene().facets;
    const FacetSoup offset = mesh.soup();
    const auto is_offset = [&](std::size_t f) {
        return offset.facets[f][0] >= mesh.scene().vertices.size();
    };
    std::vector<Polygon> in_place;
    std::vector<bool> moved;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        in_place.push_back(polygon_of(mesh.vertices(), facets[f].vertex));
        moved.push_back(is_offset(f));
    }
    if (std::ranges::find(moved, true) == moved.end())
        return {};
    std::vector<Over> all;
    const bool found = for_each_close_pair(in_place, moved, [&](std::uint32_t f, std::uint32_t g) {
        if (contact_of(in_place[f], in_place[g]) != Contact::overlay)
            return;
        for (const Over& each : {over(mesh, in_place, f, g), over(mesh, in_place, g, f)})
            if (each.distance > between_layers)
                all.push_back(each);
    });
    return found ? covered_of(all) : std::vector<CoveredSide>{};
}

} // namespace hemilux
