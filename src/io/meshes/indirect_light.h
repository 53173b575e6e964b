#pragma once
// --bake indirect: the light that arrives by at least one reflection, for programs that add the
// light of lamps themselves.

#include "bvh/tracer.h"
#include "parallel/workers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// The mean irradiance of each patch [W/m2] by what patches reflect, B - E, where
/// cosine-distributed rays from points all over the patch meet them. So many `rays` go from each
/// patch: the error falls with their square root. The same for any number of threads.
[[nodiscard]] std::vector<Vec3> indirect_irradiance(const Mesh& mesh, const Tracer& tracer,
                                                    std::span<const Vec3> radiosity, unsigned rays,
                                                    std::uint64_t seed, const Workers& workers);

} // namespace hemilux
