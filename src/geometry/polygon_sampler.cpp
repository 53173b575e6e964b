#include "geometry/polygon_sampler.h"

#include <algorithm>

namespace hemilux {

PolygonSampler::PolygonSampler(const Polygon& polygon)
    : triangle_(polygon.is_triangle()), even_(false), corner_(polygon.corner[0]) {
    const auto& [a, b, c, d] = polygon.corner;
    first_ = b - a;
    second_ = triangle_ ? c - b : d - a;
    if (triangle_)
        return;
    even_ = c - d == first_ && c - b == second_;
    if (even_) // what follows would find it too
        return;
    twist_ = (c - d) - first_;
    const Vec3 normal = polygon.area_vector();
    const auto stretch = [&](const Vec3& along, const Vec3& across) {
        return std::max(glm::dot(glm::cross(along, across), normal), 0.0);
    };
    at_ = {stretch(b - a, d - a), stretch(b - a, c - b), stretch(c - d, d - a),
           stretch(c - d, c - b)};
    even_ = at_[0] == at_[1] && at_[0] == at_[2] && at_[0] == at_[3] && twist_ == Vec3(0.0);
}

} // namespace hemilux
