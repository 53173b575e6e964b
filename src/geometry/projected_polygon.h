#pragma once
// A polygon seen from a point of a surface: how large its form factor is, and directions towards it
// that follow Lambert's law. It is what a shadow ray to an emitter needs.
//
// Only geometry: a polygon counts from either side, and nothing stands in between. A caller whose
// emitters shine to the front only tests dot(polygon.normal(), point - corner) > 0 first, and
// traces a ray along the direction for the visibility.

#include "geometry/frame.h"
#include "geometry/horizon_clip.h"
#include "geometry/polygon.h"

#include <array>

namespace hemilux {

class ProjectedPolygon {
  public:
    /// The frame's z is the surface's unit normal; what lies below the horizon is cut off.
    ProjectedPolygon(const Vec3& point, const Frame& frame, const Polygon& polygon);

    /// Form factor from the point to the polygon, unoccluded: projected solid angle / pi [-]. 0
    /// where nothing of it is above the horizon or it is seen edge-on; there is then no direction
    /// to sample.
    [[nodiscard]] double factor() const { return factor_; }
    /// A unit direction (world) towards the polygon, density cos(theta) / (pi factor()) per
    /// steradian, for u uniform in [0,1)^2. Needs factor() > 0.
    [[nodiscard]] Vec3 sample(Vec2 u) const;

  private:
    Frame frame_;
    ClippedPolygon above_;
    /// Projected solid angle of the first k + 1 triangles of the fan about vertex 0 [sr].
    std::array<double, 3> area_up_to_{};
    double factor_ = 0;
};

} // namespace hemilux
