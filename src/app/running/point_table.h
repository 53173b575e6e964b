#pragma once
// --points: the light at points that the user names.

#include "app/running/results.h"

#include <span>

namespace hemilux {

/// Throws InputError for a point so far from the scene that its coordinates could not tell rays to
/// it apart.
void check_distances(const SolveSettings& settings, std::span<const NamedPoint> points,
                     const Mesh& mesh);

/// Gathers the light and writes the table. Throws OutputError, and Interrupted some seconds after a
/// signal.
void write_points(const SolveSettings& settings, const Results& results);

} // namespace hemilux
