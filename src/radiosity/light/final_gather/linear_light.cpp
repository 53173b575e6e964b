#include "radiosity/light/final_gather/linear_light.h"

#include "geometry/frame.h"

#include <algorithm>

namespace hemilux {
namespace {

Vec2 along_axes(const Frame& frame, const Vec3& way) {
    return {glm::dot(way, frame.x), glm::dot(way, frame.y)};
}

Vec3 rise(const Slope& slope, const Vec2& way) { return way.x * slope.x + way.y * slope.y; }

} // namespace

LinearLight::LinearLight(const Patch& patch, std::span<const PatchPoint> points,
                         std::span<const Vec3> irradiance)
    : irradiance_(irradiance) {
    const Frame frame = Frame::from_normal(patch.normal);
    Vec2 middle(0.0);
    for (const PatchPoint& point : points) {
        at_.push_back(along_axes(frame, point.at.position - patch.centre));
        middle += at_.back() / double(points.size());
    }
    for (Vec2& at : at_) {
        at -= middle;
        xx_ += at.x * at.x;
        xy_ += at.x * at.y;
        yy_ += at.y * at.y;
    }
    const double determinant = xx_ * yy_ - xy_ * xy_;
    for (std::size_t e = 0; e < 2; ++e) {
        Vec3 x(0.0), y(0.0);
        for (std::size_t k = 0; k < at_.size(); ++k) {
            const Vec3& light = irradiance_[2 * k + e];
            mean_[e] += light / count();
            x += at_[k].x * light;
            y += at_[k].y * light;
        }
        if (determinant > 0)
            slope_[e] = {(yy_ * x - xy_ * y) / determinant, (xx_ * y - xy_ * x) / determinant};
    }
}

Vec3 LinearLight::variance_left() const {
    constexpr double fitted = 3;
    Vec3 products(0.0);
    for (std::size_t k = 0; k < at_.size(); ++k) {
        const auto off = [&](std::size_t e) {
            return irradiance_[2 * k + e] - mean_[e] - rise(slope_[e], at_[k]);
        };
        products += off(0) * off(1);
    }
    return products / (count() - fitted);
}

/// Sums over the middles of edges: exact for triangles; of a parallelogram's mean square it is 3 /
/// 2.
double variance_of(const Patch& patch, const Slope& slope) {
    const Frame frame = Frame::from_normal(patch.normal);
    const bool triangle = patch.shape.is_triangle();
    const std::size_t corners = triangle ? 3 : 4;
    Vec3 squares(0.0);
    for (std::size_t k = 0; k < corners; ++k) {
        const Vec3 middle =
            (patch.shape.corner[k] + patch.shape.corner[(k + 1) % corners]) / 2.0 - patch.centre;
        const Vec3 rises = rise(slope, along_axes(frame, middle));
        squares += rises * rises;
    }
    const Vec3 variance = squares / (triangle ? 3.0 : 6.0);
    return variance.x + variance.y + variance.z;
}

AgreedSlope agreed_slope(const Patch& patch, const std::array<Slope, 2>& estimates) {
    const auto& [a, b] = estimates;
    const Slope mean{.5 * (a.x + b.x), .5 * (a.y + b.y)};
    const Slope off{.5 * (a.x - b.x), .5 * (a.y - b.y)};
    // The product of the estimates is free of noise; it is compared with the square of their mean.
    const double square = variance_of(patch, mean), noise = variance_of(patch, off);
    const double agreed = square > 0 ? std::clamp(1 - noise / square, 0.0, 1.0) : 0;
    return {{agreed * mean.x, agreed * mean.y}, agreed * agreed * patch.area * noise};
}

} // namespace hemilux
