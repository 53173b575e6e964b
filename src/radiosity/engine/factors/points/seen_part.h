#pragma once
// The part of a convex polygon that others leave to be seen, exactly: from a point, or along
// parallel lines.
//
// From a point, a polygon is a cone of directions; its corners are vectors from the point. Along
// parallel lines, a corner whose place across the lines is (x, y) is the vector (x, y, 1). In both
// cases an edge is a plane through the origin, and a polygon that stands in front takes away what
// is inside of all of its planes. What is left is cut along these planes into convex pieces (Weiler
// and Atherton 1977, "Hidden surface removal using polygon area sorting").

#include "radiosity/engine/factors/pairs/convex_part.h"

#include <cstddef>
#include <span>
#include <vector>

namespace hemilux {

/// It keeps its memory from one polygon to the next.
class SeenPart {
  public:
    static constexpr std::size_t max_pieces = 256;

    /// Begins with a whole polygon, whose corners are vectors as above.
    void begin(const ConvexPart& whole);
    /// Takes away what a convex polygon in front hides. Returns false where there would be more
    /// than max_pieces pieces, or a piece with too many corners: the part is then void.
    [[nodiscard]] bool hide(const ConvexPart& cover);
    /// Returns what is left, in pieces that have no area in common.
    [[nodiscard]] std::span<const ConvexPart> pieces() const { return pieces_; }

  private:
    std::vector<ConvexPart> pieces_, next_;
    std::vector<Vec3> sides_; ///< unit normals of the cover's planes, inwards
};

/// Returns the part of a piece on the side of a plane through the origin to which `inwards` points.
[[nodiscard]] ConvexPart cut_by_plane(const ConvexPart& piece, const Vec3& inwards);

} // namespace hemilux
