#pragma once
// A polygon seen from a point of a surface: how large its form factor is, and directions towards it
// that follow Lambert's law. A shadow ray to an emitter needs this.
//
// This is only geometry: a polygon counts from either side, and nothing stands in between. A caller
// whose emitters shine only to the front first tests dot(polygon.normal(), point - corner) > 0. It
// then traces a ray along the direction for the visibility.

#include "geometry/frame.h"
#include "geometry/horizon_clip.h"
#include "geometry/polygon.h"

#include <array>

namespace hemilux {

class ProjectedPolygon {
  public:
    /// The frame's z is the surface's unit normal; what lies below the horizon is cut off.
    ProjectedPolygon(const Vec3& point, const Frame& frame, const Polygon& polygon);

    /// Returns the unoccluded form factor from the point to the polygon: projected solid angle / pi
    /// [-]. It is 0 where nothing of the polygon is above the horizon or it is seen edge-on; there
    /// is then no direction to sample.
    [[nodiscard]] double factor() const { return factor_; }
    /// Returns a unit direction (world) towards the polygon for u uniform in [0,1)^2. Its density
    /// is cos(theta) / (pi factor()) per steradian. Requires factor() > 0.
    [[nodiscard]] Vec3 sample(Vec2 u) const;

  private:
    Frame frame_;
    ClippedPolygon above_;
    /// The projected solid angle of the first k + 1 triangles of the fan about vertex 0 [sr].
    std::array<double, 3> area_up_to_{};
    double factor_ = 0;
};

} // namespace hemilux
