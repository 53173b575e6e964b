#pragma once
// Computes the form factor between two patches by shadow rays (Wallace, Elmquist and Haines 1989),
// as exactly as the light between them is important.
//
// Points of the receiver are independent batches of scrambled Sobol points, whose spread is the
// error. They grow until it is small enough.

#include "bvh/tracer.h"

#include <cstdint>
#include <span>

namespace hemilux {

class Mesh;
struct Patch;

struct PairFactor {
    double factor = 0;                            ///< F_from,to [-]
    double variance = 0;                          ///< variance of the factor
    std::uint64_t points = 0, rays = 0, hits = 0; ///< not each point needs a ray

    /// Sets the factor and its variance from independent batches of so many points each.
    void average(std::span<const double> sums, double points_each);
};

/// Returns whether each has a corner in front of the other.
[[nodiscard]] bool may_see(const Patch& a, const Patch& b);

/// Estimates F_from,to [-] without looking: the kernel between the centres, with cosines as they
/// may be elsewhere on the patches. The estimate is rather too large than too small.
[[nodiscard]] double rough_factor(const Patch& from, const Patch& to);

/// Computes the factor with about `importance` rays: more for pairs that see each other in part,
/// fewer for those that see each other well, two at least. `visibility` is false where nothing can
/// stand between two patches.
[[nodiscard]] PairFactor pair_factor(const Mesh& mesh, const Tracer& tracer, std::uint32_t from,
                                     std::uint32_t to, double importance, std::uint64_t seed,
                                     bool visibility = true);

} // namespace hemilux
