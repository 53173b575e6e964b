#pragma once
// The weight for a target of light that varies within a patch.

#include "bvh/tracer.h"
#include "parallel/workers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Returns by patch, for a target of weights w (target.h): w, and for the points of the target that
/// the patch lights, what it counts there.
///
/// An error e(x) within patch k moves the light at a point y of the target by rho_y sum F_yk e. The
/// square of this is at most rho_y^2 F_yk e^2 (Jensen). If the mean of k is right, e has no mean,
/// and only what the kernel of F changes over the patch is left. A patch of area A at the distance
/// r counts A / r^2 of that, and all of it from nearer. The weights are found by rays from points
/// of the target.
[[nodiscard]] std::vector<double> division_weights(const Mesh& mesh, const Tracer& tracer,
                                                   std::span<const double> weight,
                                                   std::uint64_t seed, const Workers& workers);

} // namespace hemilux
