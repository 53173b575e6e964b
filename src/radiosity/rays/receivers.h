#pragma once
// Which patches rays strike, many at a time: tracers answer for many at once much sooner than for
// each alone (bvh/tracer.h).

#include "bvh/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Where a ray arrived if not at a patch: in the open, or on the back of a one-sided face.
inline constexpr std::uint32_t escaped = 0xffffffff, absorbed = 0xfffffffe;

/// Rays that are worth tracing together; more gain nothing.
inline constexpr std::size_t rays_at_a_time = 1024;

/// Adds for each ray the patch that it strikes, or `escaped` or `absorbed`.
void find_receivers(std::span<const Ray> rays, const Mesh& mesh, const Tracer& tracer,
                    std::vector<std::uint32_t>& receivers);

} // namespace hemilux
