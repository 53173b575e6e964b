#pragma once
// The charts of texture coordinates that a file has.

#include "io/lightmaps/texel_map.h"

#include <vector>

namespace hemilux {

/// Gives one chart to triangles that share an end both in the lightmap and on the surface.
void join_charts(const Mesh& mesh, std::vector<PlacedTriangle>& triangles);

} // namespace hemilux
