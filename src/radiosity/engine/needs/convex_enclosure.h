#pragma once
// Finds out whether a scene is a closed convex room and nothing else. In such a room one surface is
// seen in each direction, and nothing stands between two patches.

namespace hemilux {

class Mesh;

/// Returns true if each plane has all vertices in front of it, and each edge belongs to two facets
/// that run along it in opposite directions. It returns false where that would take too long to
/// find out, in a room of some thousands of planes and vertices. It also does for a room whose
/// walls are cut at different points of an edge.
[[nodiscard]] bool is_convex_enclosure(const Mesh& mesh);

} // namespace hemilux
