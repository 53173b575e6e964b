#include "geometry/projected_polygon.h"

#include "geometry/polar_warp.h"

#include <algorithm>
#include <numbers>

namespace hemilux {

ProjectedPolygon::ProjectedPolygon(const Vec3& point, const Frame& frame, const Polygon& polygon)
    : frame_(frame) {
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i)
        corners[i] = frame.to_local(polygon.corner[i] - point);
    above_ = clip_to_horizon(corners);
    // Neighbours in the fan share a diagonal, passed once in each direction.
    double total = 0, last_diagonal = 0;
    for (std::size_t k = 0; static_cast<int>(k) + 2 < above_.size; ++k) {
        const auto& v = above_.vertex;
        const double start = k == 0 ? edge_term(v[0], v[1]) : -last_diagonal;
        last_diagonal = edge_term(v[k + 2], v[0]);
        const double area = 0.5 * (start + edge_term(v[k + 1], v[k + 2]) + last_diagonal);
        total += std::max(0.0, area);
        area_up_to_[k] = total;
    }
    factor_ = std::min(1.0, total / std::numbers::pi);
}

Vec3 ProjectedPolygon::sample(Vec2 u) const {
    const auto triangles = static_cast<std::size_t>(std::max(1, above_.size - 2));
    const double target = u.x * area_up_to_[triangles - 1];
    std::size_t k = 0;
    while (k + 1 < triangles && !(target < area_up_to_[k]))
        ++k;
    const double before = k == 0 ? 0.0 : area_up_to_[k - 1];
    const double share = (target - before) / (area_up_to_[k] - before);
    // Rounding may lead to a last triangle that is empty.
    const double u_x = share >= 0 && share <= 1 ? share : 0.5;
    const Vec3 direction =
        PolarWarp(glm::normalize(above_.vertex[0]), glm::normalize(above_.vertex[k + 1]),
                  glm::normalize(above_.vertex[k + 2]))
            .sample({u_x, u.y});
    return frame_.to_world(direction);
}

} // namespace hemilux
