#pragma once
// The sides of facets that are laid flat together in a lightmap.
//
// A region grows from its largest facet over edges to neighbours of the same material that look
// nearly the same way. It is projected along its first normal, so a facet shrinks by the cosine
// between both: the limit of that cosine bounds how far texels are stretched. No two facets of a
// region lie over each other in the projection; those that would are left to other regions. In the
// end small regions join larger ones beside them where a lower limit allows it.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

struct ChartSide {
    std::uint32_t facet;
    bool back; ///< the reverse of a two-sided facet
};

struct ChartRegion {
    Vec3 normal; ///< unit, local frame: the direction of the projection
    std::vector<ChartSide> sides;
};

/// Returns regions that hold each of these sides once. The result depends on the mesh and the sides
/// alone.
[[nodiscard]] std::vector<ChartRegion> find_chart_regions(const Mesh& mesh,
                                                          std::span<const ChartSide> sides);

/// Returns two axes, unit and perpendicular to a normal.
struct PlaneAxes {
    Vec3 along, across;
};
/// Returns the axes, among those along edges of the region, whose rectangle around it is smallest;
/// `along` is the direction in which this is longer.
[[nodiscard]] PlaneAxes axes_of(const Mesh& mesh, const ChartRegion& region);

} // namespace hemilux
