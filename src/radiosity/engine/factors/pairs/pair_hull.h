#pragma once
// The convex hull of two patches: all lines of sight between them run in it. Where no facet reaches
// into it, the two see each other wholly, and that is certain.

#include "bvh/wide/shaft.h"
#include "radiosity/engine/factors/pairs/convex_part.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"

namespace hemilux {

class PairHull {
  public:
    /// The parts are those in front of each other's planes. What is nearer than `rounding`
    /// [length] to the surface of the hull is outside.
    PairHull(const ConvexPart& a, const Plane& plane_of_a, const ConvexPart& b,
             const Plane& plane_of_b, double rounding);

    /// Returns the hull, to ask a tree for what may reach into it.
    [[nodiscard]] const Shaft& sides() const { return sides_; }
    /// Returns whether a polygon reaches into the hull.
    [[nodiscard]] bool holds_some_of(const Polygon& polygon) const;

  private:
    void add_sides(const ConvexPart& of, const ConvexPart& other, double rounding);

    Shaft sides_; ///< unit normals
};

} // namespace hemilux
