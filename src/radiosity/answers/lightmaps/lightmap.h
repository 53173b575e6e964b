#pragma once
// The light of a mesh as a picture over its charts.

#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/images/image.h"

#include <span>

namespace hemilux {

/// Paints a picture of size x size texels. The middle of a texel has the light of the nearest point
/// of its chart, interpolated within the triangles of write_glb(). `light` is by divided class of
/// corners. Texels farther from every chart than the gutter are black.
[[nodiscard]] Image lightmap(const std::vector<LightmapChart>& charts, const ChartCorners& corners,
                             std::span<const Vec3> light, int size);

} // namespace hemilux
