#pragma once
// Unit vectors.

#include "geometry/vector.h"

#include <cmath>

namespace hemilux {

/// The unit vector along a vector of any length above 0: the squares of very long and very short
/// ones are beyond the numbers that there are.
[[nodiscard]] inline Vec3 direction_of(const Vec3& v) {
    return glm::normalize(v / std::abs(v[largest_axis(v)]));
}

} // namespace hemilux
