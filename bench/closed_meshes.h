#pragma once
// Meshes without a hole, seen from inside: neighbours share their vertices, and fronts face inward.

#include "radiosity/paper/scene/scene.h"

#include <cstddef>
#include <cstdint>

namespace hemilux::bench {

/// An octahedron divided `level` times: 8 * 4^level triangles.
[[nodiscard]] Scene closed_sphere(int level);

/// A box, four sides of which are 2 n slivers each, about n / 2 times as long as wide.
[[nodiscard]] Scene box_of_slivers(std::uint32_t n);

/// The parts of a scene, connected by edges, in which each edge belongs to two facets that run
/// along it in opposite directions, turned so that their fronts face inward. Vertices at one place
/// are one. Flat parts, which enclose nothing, are left out.
[[nodiscard]] Scene closed_parts(const Scene& scene);

} // namespace hemilux::bench
