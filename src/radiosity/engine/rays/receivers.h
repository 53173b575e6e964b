#pragma once
// Finds which patches rays hit. Tracers answer for many rays at once much sooner than for each
// alone (bvh/tracer.h).

#include "bvh/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// The receivers of rays that hit no patch: such a ray leaves the scene, or falls on the back of a
/// one-sided face.
inline constexpr std::uint32_t escaped = 0xffffffff, absorbed = 0xfffffffe;

/// The number of rays that it pays to trace together; more gain nothing.
inline constexpr std::size_t rays_at_a_time = 1024;

/// Appends for each ray the patch that it hits, or `escaped` or `absorbed`.
void find_receivers(std::span<const Ray> rays, const Mesh& mesh, const Tracer& tracer,
                    std::vector<std::uint32_t>& receivers);

} // namespace hemilux
