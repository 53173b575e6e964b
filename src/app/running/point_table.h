#pragma once
// --points: the light at points that the user names.

#include "app/running/results.h"

#include <span>
#include <vector>

namespace hemilux {

/// Reads the points of --points; none if it is not given. Throws InputError.
[[nodiscard]] std::vector<NamedPoint> points_of(const SolveSettings& settings);

/// Throws InputError for a point so far from the scene that its coordinates could not tell rays to
/// it apart.
void check_distances(const SolveSettings& settings, std::span<const NamedPoint> points,
                     const Mesh& mesh);

/// Gathers the light and writes the table. Throws OutputError, and Interrupted some seconds after a
/// signal.
void write_points(const SolveSettings& settings, const Results& results);

} // namespace hemilux
