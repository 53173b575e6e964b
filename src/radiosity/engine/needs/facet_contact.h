#pragma once
// Finds which facets pass through each other, or lie on each other.

#include "geometry/box.h"
#include "geometry/polygon.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

enum class Contact {
    apart,
    touching, ///< they share a line or a point
    overlay,  ///< both lie in one plane and share a part of it
    crossing  ///< one passes through the other, as far as is known
};

/// Finds the contact of two convex polygons within [-1,1]^3 by separating axes (Gottschalk, Lin and
/// Manocha 1996, "OBBTree"). Distances and depths below 1e-9 count as none.
[[nodiscard]] Contact contact_of(const Polygon& a, const Polygon& b);

/// Returns whether two polygons that touch do so at a point that is not on the boundary of `a`.
[[nodiscard]] bool touches_inside(const Polygon& a, const Polygon& b);

/// Returns whether two polygons have common points besides corners and an edge that they share.
[[nodiscard]] bool meet_beside_shared_edge(const Polygon& a, const Polygon& b);

/// Layers of facets in one plane are farther apart (light/layers/layered_mesh.h) [local units].
inline constexpr double between_layers = 1e-9;

/// Returns whether polygon a lies within b, given that it lies in its plane.
[[nodiscard]] bool lies_within(const Polygon& a, const Polygon& b);

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
            if (meet(item.box, first->box)) {
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

} // namespace hemilux
