#include "radiosity/engine/factors/pairs/pair_hull.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {
namespace {

double highest(const ConvexPart& part, const Vec3& direction) {
    double high = glm::dot(part.corner[0], direction);
    for (std::size_t k = 1; k < part.size; ++k)
        high = std::max(high, glm::dot(part.corner[k], direction));
    return high;
}

/// Returns the part of a polygon inside one half-space (Sutherland and Hodgman 1974).
ConvexPart inside(const ConvexPart& part, const Shaft::HalfSpace& side) {
    std::array<double, 28> depth;
    bool any_in = false, any_out = false;
    for (std::size_t k = 0; k < part.size; ++k) {
        depth[k] = side.offset - glm::dot(side.normal, part.corner[k]);
        any_in |= depth[k] > 0;
        any_out |= depth[k] < 0;
    }
    if (!any_in)
        return {};
    if (!any_out)
        return part;
    ConvexPart kept;
    for (std::size_t k = 0; k < part.size; ++k) {
        const std::size_t next = k + 1 < part.size ? k + 1 : 0;
        if (depth[k] >= 0)
            kept.add(part.corner[k]);
        if ((depth[k] < 0 && depth[next] > 0) || (depth[k] > 0 && depth[next] < 0))
            kept.add(
                glm::mix(part.corner[k], part.corner[next], depth[k] / (depth[k] - depth[next])));
    }
    return kept;
}

} // namespace

PairHull::PairHull(const ConvexPart& a, const Plane& plane_of_a, const ConvexPart& b,
                   const Plane& plane_of_b, double rounding) {
    for (const Plane& plane : {plane_of_a, plane_of_b})
        sides_.add(-plane.normal, -glm::dot(plane.normal, plane.point) - rounding);
    add_sides(a, b, rounding);
    add_sides(b, a, rounding);
    Box box = box_of(a.corners());
    box.include(box_of(b.corners()));
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 outwards(0.0);
        outwards[axis] = 1;
        sides_.add(outwards, box.high[axis] - rounding);
        sides_.add(-outwards, -box.low[axis] - rounding);
    }
}

/// Each side of the hull holds an edge of one and a corner of the other. Turned about the edge, a
/// plane meets all corners of the other within half a turn, as they are in front of the edge's
/// polygon; the side goes through the last. A side that does not bound both is not one, whatever
/// rounding says.
void PairHull::add_sides(const ConvexPart& of, const ConvexPart& other, double rounding) {
    const Vec3 middle = [&] {
        Vec3 sum(0.0);
        for (const Vec3& corner : of.corners())
            sum += corner;
        return sum / static_cast<double>(of.size);
    }();
    for (std::size_t k = 0; k < of.size; ++k) {
        const Vec3 &p = of.corner[k], edge = of.next(k) - p;
        Vec3 normal(0.0);
        double longest = 0;
        for (const Vec3& c : other.corners()) {
            if (longest > 0 && !(glm::dot(normal, c - p) > 0))
                continue;
            Vec3 candidate = glm::cross(edge, c - p);
            if (glm::dot(candidate, middle - p) > 0)
                candidate = -candidate;
            const double length = glm::length(candidate);
            if (!(length > 1e-12 * glm::length(edge)))
                continue;
            normal = candidate / length;
            longest = length;
        }
        if (!(longest > 0))
            continue;
        sides_.add(normal, std::max(highest(of, normal), highest(other, normal)) - rounding);
    }
}

bool PairHull::holds_some_of(const Polygon& polygon) const {
    std::array<std::size_t, std::tuple_size_v<decltype(Shaft::side)>> cutting;
    std::size_t cuts = 0;
    for (std::size_t k = 0; k < sides_.size; ++k) {
        const Shaft::HalfSpace& side = sides_.side[k];
        unsigned outside = 0;
        for (const Vec3& corner : polygon.corner)
            outside += glm::dot(side.normal, corner) >= side.offset ? 1 : 0;
        if (outside == polygon.corner.size())
            return false;
        if (outside > 0)
            cutting[cuts++] = k;
    }
    ConvexPart part = part_of(polygon);
    for (std::size_t k = 0; k < cuts && !part.empty(); ++k)
        part = inside(part, sides_.side[cutting[k]]);
    return !part.empty();
}

} // namespace hemilux
