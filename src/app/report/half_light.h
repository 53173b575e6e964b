#pragma once
// Light in half precision (IEEE 754 binary16), small enough to keep that of many steps.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Returns the nearest half. What is too large becomes the largest one, 65504, and what is not a
/// number becomes 0.
[[nodiscard]] std::uint16_t half_of(double value);

/// Returns three halves for each radiosity, as multiples of `unit` [W/m2].
[[nodiscard]] std::vector<std::uint16_t> halves_of(std::span<const Vec3> radiosity, double unit);

/// Returns the mean of the radiosity over area and channels [W/m2]; 1 where there is none.
[[nodiscard]] double mean_light(const Mesh& mesh, std::span<const Vec3> radiosity);

} // namespace hemilux
