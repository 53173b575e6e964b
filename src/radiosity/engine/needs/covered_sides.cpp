#include "radiosity/engine/needs/covered_sides.h"

#include "bvh/intersect.h"
#include "geometry/box.h"
#include "geometry/polygon.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace hemilux {
namespace {

/// Layers of facets in one plane are farther apart (light/layers/layered_mesh.h) [local units].
constexpr double between_layers = 1e-9;
/// Depths and distances below this count as none [local units].
constexpr double thin = 1e-9;

Vec3 edge_of(const Polygon& p, std::size_t k) { return p.corner[(k + 1) % 4] - p.corner[k]; }

/// Returns whether an axis separates the polygons, or they only touch along it. An axis without
/// length separates nothing.
bool separates(const Vec3& direction, const Polygon& a, const Polygon& b) {
    const double length = glm::length(direction);
    if (!(length > 0))
        return false;
    const auto range = [&](const Polygon& p) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& corner : p.corner) {
            const double at = glm::dot(direction, corner) / length;
            low = std::min(low, at);
            high = std::max(high, at);
        }
        return std::array{low, high};
    };
    const auto [a_low, a_high] = range(a);
    const auto [b_low, b_high] = range(b);
    return std::max(b_low - a_high, a_low - b_high) >= -thin;
}

/// Returns whether an edge of one polygon separates the two within their plane.
bool has_separating_edge(const Polygon& a, const Polygon& b) {
    for (const Polygon* p : {&a, &b})
        for (std::size_t k = 0; k < 4; ++k)
            if (separates(glm::cross(p->area_vector(), edge_of(*p, k)), a, b))
                return true;
    return false;
}

/// Returns whether all corners lie in the other's plane.
bool lies_in_plane_of(const Polygon& a, const Polygon& b) {
    const Vec3 n = b.normal();
    return std::ranges::all_of(
        a.corner, [&](const Vec3& p) { return std::abs(glm::dot(n, p - b.corner[0])) <= thin; });
}

/// Returns whether polygon a lies within b, given that it lies in its plane.
bool lies_within(const Polygon& a, const Polygon& b) {
    const Vec3 n = b.normal();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 inward = glm::cross(n, edge_of(b, k));
        const double length = glm::length(inward);
        if (std::ranges::any_of(a.corner, [&](const Vec3& p) {
                return glm::dot(inward, p - b.corner[k]) < -thin * length;
            }))
            return false;
    }
    return true;
}

/// Returns whether two convex polygons within [-1,1]^3 lie in one plane and share a part of it, by
/// separating axes.
bool lie_on_each_other(const Polygon& a, const Polygon& b) {
    return (lies_in_plane_of(a, b) || lies_in_plane_of(b, a)) && !has_separating_edge(a, b);
}

bool boxes_touch(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) &&
           glm::all(glm::lessThanEqual(b.low, a.high));
}

/// Calls visit(f, g) for each pair of polygons whose boxes overlap or touch and one of which is
/// `wanted`, in either order. Sorts them along x (Cohen et al. 1995, "I-COLLIDE"). Returns false
/// where that is given up, as there are too many to be compared.
template <class Visit>
bool for_each_close_pair(std::span<const Polygon> shapes, const std::vector<bool>& wanted,
                         const Visit& visit) {
    constexpr std::size_t max_looks = 50'000'000, max_close_pairs = 2'000'000;
    constexpr double rounding = 1e-9;
    struct Item {
        Box box;
        std::uint32_t shape;
    };
    std::vector<Item> all, some;
    for (std::uint32_t f = 0; f < shapes.size(); ++f) {
        const Box exact = box_of(shapes[f].corner);
        all.push_back({{exact.low - rounding, exact.high + rounding}, f});
    }
    std::ranges::sort(all, {}, [](const Item& i) { return std::pair(i.box.low.x, i.shape); });
    for (const Item& item : all)
        if (wanted[item.shape])
            some.push_back(item);
    std::size_t looks = 0, pairs = 0;
    const auto visit_after = [&](const Item& item, auto first, auto last) {
        for (; first != last && first->box.low.x <= item.box.high.x; ++first) {
            ++looks;
            if (boxes_touch(item.box, first->box)) {
                ++pairs;
                visit(item.shape, first->shape);
            }
        }
    };
    auto next = some.begin(); // the first wanted one behind `item`
    for (auto item = all.begin(); item != all.end(); ++item) {
        if (wanted[item->shape])
            visit_after(*item, item + 1, all.end());
        else
            visit_after(*item, next, some.end());
        if (looks > max_looks || pairs > max_close_pairs)
            return false;
        if (wanted[item->shape])
            ++next;
    }
    return true;
}

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
        if (!lie_on_each_other(in_place[f], in_place[g]))
            return;
        for (const Over& each : {over(mesh, in_place, f, g), over(mesh, in_place, g, f)})
            if (each.distance > between_layers)
                all.push_back(each);
    });
    return found ? covered_of(all) : std::vector<CoveredSide>{};
}

} // namespace hemilux
