#pragma once
// The technique of 1997 divides a spherical triangle (paper section 4) by a new point on each edge,
// nearer to the end where more surfaces are.

#include "geometry/vector.h"

#include <array>
#include <cstddef>

namespace hemilux {

/// A unit vector and the number of surfaces that a ray found along it, or would probably find: ns
/// or ens in the paper.
struct CountedDirection {
    Vec3 direction;
    double surfaces; ///< [-]; the mean of integers where it is estimated
};

/// The corners of a triangle, counter-clockwise seen from outside.
using CountedTriangle = std::array<CountedDirection, 3>;

/// Returns how far from P1 towards P2 the new point P3 lies, as a share of the edge in [0,1].
/// Equation (1) gives P3P1 / P2P3 = ns(P2) / ns(P1). The share is one half where nothing was found
/// along P1 or P2.
[[nodiscard]] double division_share(double ns_1, double ns_2);

/// Returns the point at this share of the shorter arc from a to b, both of unit length and not
/// opposite.
[[nodiscard]] Vec3 point_on_arc(const Vec3& a, const Vec3& b, double share);

/// Returns the new point F of the edge AB with its estimated count: AF / FB = ens(B) / ens(A) and
/// ens(F) = (ens(A) BF + ens(B) AF) / AB.
[[nodiscard]] CountedDirection estimated_point(const CountedDirection& a,
                                               const CountedDirection& b);

/// Returns child 0 to 3 of the triangle ABC with estimated points on its edges: those at A, B and
/// C, then the middle one.
[[nodiscard]] CountedTriangle estimated_child(const CountedTriangle& triangle, std::size_t child);

} // namespace hemilux
