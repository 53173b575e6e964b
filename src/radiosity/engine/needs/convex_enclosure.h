#pragma once
// Finds out whether a scene is a closed convex room and nothing else. In such a room one surface is
// seen in each direction, and nothing stands between two patches.

namespace hemilux {

class Mesh;

enum class Enclosure {
    not_found, ///< not a closed convex room, or not found to be one in time
    cut_edges, ///< one whose walls are cut at different points of an edge
    tight      ///< one whose facets share all corners and edges, so that no ray leaks out
};

/// In a closed convex room each plane has all vertices in front of it, and each edge, or each piece
/// of an edge that corners of others cut, belongs to two facets that run along it in opposite
/// directions. It is not looked for among some thousands of planes and vertices. A scene with panes
/// is none, as light may end between its walls.
[[nodiscard]] Enclosure convex_enclosure(const Mesh& mesh);

} // namespace hemilux
