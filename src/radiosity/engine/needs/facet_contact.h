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

[[nodiscard]] inline bool overlap(const Box& a, const Box& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) &&
           glm::all(glm::lessThanEqual(b.low, a.high));
}

/// Calls visit(f, g) for each pair of polygons whose boxes overlap, f < g or g < f. Sorts them
/// along x (Cohen et al. 1995, "I-COLLIDE"). Returns false where that is given up, as there are too
/// many to be compared; that takes a quarter of a second at most.
template <class Visit>
bool for_each_close_pair(std::span<const Polygon> shapes, const Visit& visit) {
    constexpr std::size_t max_looks = 50'000'000, max_pairs = 2'000'000;
    std::vector<Box> box;
    constexpr double rounding = 1e-9;
    for (const Polygon& shape : shapes) {
        const Box exact = box_of(shape.corner);
        box.push_back({exact.low - rounding, exact.high + rounding});
    }
    std::vector<std::uint32_t> order(box.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t f) { return std::pair(box[f].low.x, f); });
    std::size_t looks = 0, pairs = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const std::uint32_t f = order[i], g = order[j];
            if (box[g].low.x > box[f].high.x)
                break;
            if (++looks > max_looks)
                return false;
            if (!overlap(box[f], box[g]))
                continue;
            if (++pairs > max_pairs)
                return false;
            visit(f, g);
        }
    return true;
}

} // namespace hemilux
