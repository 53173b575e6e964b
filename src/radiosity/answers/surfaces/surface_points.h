#pragma once
// Points that get rows of view factors: where they are in the scene.

#include "radiosity/answers/surfaces/surface_rows.h"
#include "radiosity/engine/factors/points/point_factors.h"

#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;

/// Finds the points in the local frame, each on the face that it lies on (sensor_at()).
[[nodiscard]] std::vector<FactorPoint> factor_points(std::span<const FactorPlace> places,
                                                     const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
