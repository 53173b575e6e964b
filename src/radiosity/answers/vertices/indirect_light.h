#pragma once
// --bake indirect: the light that arrives by at least one reflection, for programs that add the
// light of emitters themselves.

#include "bvh/tracer.h"
#include "parallel/workers.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Estimates the mean irradiance of each patch [W/m2] by what other patches reflect, B - E.
/// Cosine-distributed rays from points all over the patch find these. Each patch sends `rays` of
/// them, and the error falls with their square root. The result is the same for any number of
/// threads. `give_up` is asked before each few patches, by any thread; where it returns true,
/// Interrupted is thrown.
[[nodiscard]] std::vector<Vec3> indirect_irradiance(const Mesh& mesh, const Tracer& tracer,
                                                    std::span<const Vec3> radiosity, unsigned rays,
                                                    std::uint64_t seed, const Workers& workers,
                                                    const std::function<bool()>& give_up = {});

} // namespace hemilux
