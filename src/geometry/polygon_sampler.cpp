#include "geometry/polygon_sampler.h"

namespace hemilux {
namespace {

double triangle_area(const Vec3& edge, const Vec3& across) {
    return 0.5 * glm::length(glm::cross(edge, edge + across));
}

} // namespace

PolygonSampler::PolygonSampler(const Polygon& polygon) : corner_(polygon.corner[0]) {
    const auto& [a, b, c, d] = polygon.corner;
    edge_ = {b - a, c - b, c - a, d - c};
    parallelogram_ = !polygon.is_triangle() && b - a == c - d;
    if (parallelogram_) {
        edge_[1] = d - a;
    } else if (!polygon.is_triangle()) {
        const double first = triangle_area(edge_[0], edge_[1]);
        const double both = first + triangle_area(edge_[2], edge_[3]);
        split_ = both > 0 ? first / both : 1.0;
    }
}

} // namespace hemilux
