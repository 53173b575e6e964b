#pragma once
// What two patches exchange with nothing in between, as exactly as it is asked for.
//
// Two patches far from each other are integrated over their areas by a product of Gauss rules,
// whose error falls as the 2n-th power of their size over their distance. Near and touching pairs,
// and those of which one reaches behind the other's plane, are integrated along their contours
// (exchange_area.h), where common edges and corners are integrable.

#include "geometry/polygon.h"
#include "radiosity/engine/factors/pairs/convex_part.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

/// The side of a patch, with what integrals over it need.
struct FacePlane {
    Polygon shape;
    Plane plane;       ///< point and unit normal of the side
    Vec3 centre;       ///< centre of mass
    double area = 0;   ///< in the square of the unit of the corners
    double radius = 0; ///< largest distance of a corner from the centre
};
[[nodiscard]] FacePlane face_plane(const Polygon& shape);
/// Returns those of all patches.
[[nodiscard]] std::vector<FacePlane> face_planes(const Mesh& mesh);

/// This says how two sides stand to each other.
enum class Facing : std::uint8_t {
    never, ///< one lies behind the other's plane
    wholly,
    partly ///< one reaches behind the other's plane
};
/// Heights up to `rounding` [length] above a plane count as in it.
[[nodiscard]] Facing facing(const FacePlane& a, const FacePlane& b, double rounding);

/// The accuracy that is asked for, as a share of what the smaller of two patches emits.
enum class FreeAccuracy : std::uint8_t {
    rough, ///< about 1e-5 of the value, where a sampled share multiplies it
    exact  ///< below 1e-10 of the smaller area
};

/// Returns A F [square of the unit of length] of two sides that face each other. Heights up to
/// `rounding` above a plane count as in it.
[[nodiscard]] double free_exchange(const FacePlane& a, const FacePlane& b, Facing facing,
                                   FreeAccuracy accuracy, double rounding);

/// Returns what the exchange is not larger than, for 20 nanoseconds: from the least distance that
/// the circles about the two leave, and the largest heights over each other's planes.
[[nodiscard]] double exchange_bound(const FacePlane& a, const FacePlane& b);

} // namespace hemilux
