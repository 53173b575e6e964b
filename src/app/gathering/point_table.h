#pragma once
// --points: the light at points that the user names.

#include "app/gathering/gathered_light.h"

#include <span>
#include <string>

namespace hemilux {

/// Throws InputError for a point of the file so far from the scene that its coordinates could not
/// tell rays to it apart.
void check_distances(const std::string& path, std::span<const NamedPoint> points, const Mesh& mesh);

/// Writes the table of what was gathered. Throws OutputError, and Interrupted where a signal left
/// no light of patches either.
void write_points(const std::string& path, const Mesh& mesh, std::span<const NamedPoint> points,
                  const GatheredLight& gathered, const Workers& workers,
                  const csv::MoreColumns& more = {});

} // namespace hemilux
