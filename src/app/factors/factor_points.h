#pragma once
// The points of `viewfactors --points`: how they are read, named and found in the scene.

#include "io/results/points.h"
#include "io/results/view_factor_files.h"
#include "radiosity/engine/factors/points/point_factors.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;

/// Returns the points as rows: `point 0` and so on, as the file has them.
[[nodiscard]] std::vector<FactorPlace> places_of(std::span<const NamedPoint> points);

/// Finds the points in the local frame, each on the face that it lies on (sensor_at()).
[[nodiscard]] std::vector<FactorPoint> factor_points(std::span<const FactorPlace> places,
                                                     const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
