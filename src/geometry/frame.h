#pragma once
// A right-handed orthonormal frame of a surface: z is its normal.

#include "geometry/elementary.h"
#include "geometry/vector.h"

#include <cmath>

namespace hemilux {

struct Frame {
    Vec3 x, y, z;

    /// Returns the frame of a unit normal (Duff et al. 2017, "Building an orthonormal basis,
    /// revisited").
    [[nodiscard]] static Frame from_normal(const Vec3& n) {
        const double sign = std::copysign(1.0, n.z);
        const double a = -1.0 / (sign + n.z);
        const double b = n.x * n.y * a;
        return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x},
                {b, sign + n.y * n.y * a, -n.y},
                n};
    }
    /// Returns this frame turned about its normal by an angle [rad].
    [[nodiscard]] Frame turned(double angle) const { return turned(elementary::on_circle(angle)); }
    /// Does the same by the angle's cosine and sine.
    [[nodiscard]] Frame turned(Vec2 to) const {
        return {to.x * x + to.y * y, to.x * y - to.y * x, z};
    }
    [[nodiscard]] Vec3 to_world(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] Vec3 to_local(const Vec3& v) const {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};

} // namespace hemilux
