#pragma once
// Finds what a scene needs: work that would not change its solution is left out.
//
// This small analysis of the mesh is made once. Methods and tracers ask it before they do their
// work. docs/paper/decisions.md says which omission keeps every byte and which keeps the result
// within its error.

#include "radiosity/paper/scene/needs.h"

namespace hemilux {

class Mesh;

/// Finds the needs of a scene in O(facets) time; in scenes made to be difficult it finds out less.
/// The answer is conservative: what is uncertain is needed.
[[nodiscard]] Needs find_needs(const Mesh& mesh);

/// Returns whether rays need a tree, as find_needs() finds it, without the rest of the analysis.
[[nodiscard]] bool needs_tree(const Mesh& mesh);

/// Up to so many triangles form one leaf of the tree, tested at once. With more of them boxes pay
/// (measured in docs/measured/results.md).
inline constexpr std::size_t max_triangles_without_tree = 8;

} // namespace hemilux
