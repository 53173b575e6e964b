#pragma once
// The points from which the texels of a coarse smooth surface gather: its facets are flat, and the
// normals at their corners say how the surface that they stand for is bent.

#include "bvh/tracer.h"
#include "geometry/vector.h"
#include "radiosity/engine/rays/surface_point.h"

#include <glm/vec3.hpp>

#include <array>

namespace hemilux {

/// The normals at the corners of a facet, on its front side, unit; all zero where it has none.
using CornerNormals = std::array<glm::vec3, 4>;

/// A triangle of a facet with its normals, on the side that is looked from.
struct SmoothTriangle {
    std::array<Vec3, 3> corner; ///< local units
    std::array<Vec3, 3> normal; ///< unit
};

/// Returns the point (1-u-v, u, v) of a triangle as it receives light: with the normal between
/// those of its corners, above the flat triangle where the surface bulges. Such a point is the mean
/// of the projections onto the planes that touch the surface at the corners (Hanika 2021, Hacking
/// the shadow terminator, Ray Tracing Gems II, equation 2). So light that arrives from below the
/// triangle's plane passes over its neighbours, as it does on the surface, and no facet shows at
/// the limit of a shadow. Where the surface is hollow, or something stands closely above, the point
/// is on the triangle but for a rounding error. Its rays may meet the facet, so none gets below it.
/// `flat` is the same point of the flat triangle; it is returned where the normals are not within
/// 90 degrees of its own.
[[nodiscard]] SurfacePoint smooth_point(const SurfacePoint& flat, const SmoothTriangle& triangle,
                                        double u, double v, const Tracer& tracer);

} // namespace hemilux
