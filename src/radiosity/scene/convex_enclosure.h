#pragma once
// Whether a scene is a closed convex room and nothing else: then one surface is seen in each
// direction, and nothing stands between two patches.

namespace hemilux {

class Mesh;

/// True if each plane has all vertices in front of it, and each edge belongs to two facets that run
/// along it in opposite directions. False where that would take too long to find out: in a room of
/// some thousands of planes and vertices, or one whose walls are cut at different points of an
/// edge.
[[nodiscard]] bool is_convex_enclosure(const Mesh& mesh);

} // namespace hemilux
