#pragma once
// Light in half precision (IEEE 754 binary16), small enough to keep that of many steps.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The nearest half; what is too large is the largest one, 65504, and what is not a number 0.
[[nodiscard]] std::uint16_t half_of(double value);

/// Three halves for each radiosity: how many times `unit` it is.
[[nodiscard]] std::vector<std::uint16_t> halves_of(std::span<const Vec3> radiosity, double unit);

} // namespace hemilux
