#pragma once
// How much of its hemisphere a point of one patch gives to another patch: the kernel of form
// factors by shadow rays (Wallace, Elmquist and Haines 1989), here with Lambert's closed form of
// point and polygon in place of their disc.

#include "bvh/tracer.h"

#include <array>
#include <cstdint>

namespace hemilux {

class Mesh;

/// The form factor from a random point of the patch `from` to the whole patch `to` if a random ray
/// between them arrives, else 0; its mean over u in [0,1)^4 is F_from,to [-]. Adds to `rays` if a
/// ray had to be traced. `visibility`: false where nothing can stand between two patches.
[[nodiscard]] double point_to_patch(const Mesh& mesh, const Tracer& tracer, std::uint32_t from,
                                    std::uint32_t to, const std::array<double, 4>& u,
                                    std::uint64_t& rays, bool visibility = true);

} // namespace hemilux
