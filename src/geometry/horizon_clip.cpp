#include "geometry/horizon_clip.h"

#include "geometry/elementary.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// Returns six times the volume between the point and the polygon. It is positive where its corners
/// run counter-clockwise seen from outside the sphere, and 0 where it is seen edge-on.
double signed_volume(const std::array<Vec3, 4>& c) {
    const Vec3 across = glm::cross(c[2] - c[0], c[3] - c[1]);
    double reach = 0;
    for (const Vec3& corner : c)
        reach = std::max(reach, glm::length(corner));
    const double volume = glm::dot(c[0], across);
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    return std::abs(volume) > rounding * reach * glm::length(across) ? volume : 0.0;
}

/// Moves a corner that is seen within 1e-6 rad of the horizon onto the horizon itself. Rounding may
/// have moved it off. That must not decide which corners are cut off, because samples depend on
/// these.
Vec3 off_rounding(const Vec3& corner) {
    constexpr double rounding = 1e-6;
    const bool is_level = std::abs(corner.z) <= rounding * glm::length(corner);
    return {corner.x, corner.y, is_level ? 0.0 : corner.z};
}

Vec3 horizon_crossing(const Vec3& above, const Vec3& below) {
    const Vec3 point = above + (below - above) * (above.z / (above.z - below.z));
    return {point.x, point.y, 0.0};
}

} // namespace

ClippedPolygon clip_to_horizon(const std::array<Vec3, 4>& corners) {
    ClippedPolygon result;
    const double volume = signed_volume(corners);
    if (!(std::abs(volume) > 0))
        return result;
    std::array<Vec3, 4> clean;
    std::transform(corners.begin(), corners.end(), clean.begin(), off_rounding);
    const auto add = [&](const Vec3& v) {
        if (result.size < 5)
            result.vertex[static_cast<std::size_t>(result.size++)] = v;
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3& a = clean[volume > 0 ? i : 3 - i];
        const Vec3& b = clean[volume > 0 ? (i + 1) % 4 : (6 - i) % 4];
        if (a == b)
            continue; // a triangle's last corner stands there twice
        if (a.z >= 0)
            add(a);
        if (a.z > 0 && b.z < 0)
            add(horizon_crossing(a, b));
        if (a.z < 0 && b.z > 0)
            add(horizon_crossing(b, a));
    }
    if (result.size < 3)
        result.size = 0;
    return result;
}

double edge_term(const Vec3& a, const Vec3& b) {
    const Vec3 m = glm::cross(a, b - a); // a x b, accurate for short edges
    const double length = glm::length(m);
    return length > 0 ? elementary::atan2(length, glm::dot(a, b)) * (m.z / length) : 0.0;
}

} // namespace hemilux
