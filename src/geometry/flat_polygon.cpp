#include "geometry/flat_polygon.h"

#include <cmath>

namespace hemilux {
namespace {

/// Returns whether the whole of `b` lies right of an edge of `a`, or on it, up to `distance`.
bool lies_beside_an_edge(const FlatPolygon& b, const FlatPolygon& a, double distance) {
    for (std::size_t i = 0; i < a.size; ++i) {
        const Line edge = a.edge(i);
        const double limit = distance * (std::abs(edge.along.x) + std::abs(edge.along.y));
        std::size_t beside = 0;
        while (beside < b.size && edge.left_distance(b.corner[beside]) <= limit)
            ++beside;
        if (beside == b.size)
            return true;
    }
    return false;
}

} // namespace

double FlatPolygon::area() const {
    double twice = 0;
    for (std::size_t i = 2; i < size; ++i)
        twice += cross(corner[i - 1] - corner[0], corner[i] - corner[0]);
    return 0.5 * twice;
}

bool are_apart(const FlatPolygon& a, const FlatPolygon& b, double distance) {
    return lies_beside_an_edge(a, b, distance) || lies_beside_an_edge(b, a, distance);
}

FlatPolygon left_part(const FlatPolygon& shape, const Line& line) {
    FlatPolygon kept;
    for (std::size_t i = 0; i < shape.size; ++i) {
        const Vec2 here = shape.corner[i], next = shape.corner[i + 1 < shape.size ? i + 1 : 0];
        const double h = line.left_distance(here), n = line.left_distance(next);
        if (h >= 0)
            kept.add(here);
        if ((h >= 0) != (n >= 0))
            kept.add(here + (h / (h - n)) * (next - here));
    }
    return kept;
}

FlatPolygon common_part(const FlatPolygon& a, const FlatPolygon& b) {
    FlatPolygon common = a;
    for (std::size_t i = 0; i < b.size && common.size > 0; ++i)
        common = left_part(common, b.edge(i));
    return common;
}

} // namespace hemilux
