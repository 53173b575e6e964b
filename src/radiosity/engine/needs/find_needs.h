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

} // namespace hemilux
