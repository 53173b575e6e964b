#pragma once
// Makes the mesh of a real scene: facets that lie over each other in one plane are set apart first
// (coplanar_layers.h).

#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

/// Throws as Mesh does.
[[nodiscard]] Mesh layered_mesh(Scene scene, const MeshOptions& options = {});

} // namespace hemilux
