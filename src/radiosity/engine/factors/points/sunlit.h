#pragma once
// The sunlit fraction of patches: the share of the area that sees the sun from its front.
//
// Along the rays of one direction, what hides a patch is a polygon across them. So the shadow is
// cut out exactly, as what hides a patch from a point is (seen_part.h). Where too much lies in
// between, rays from points of the patch say which share arrives.

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/points/point_factors.h"
#include "radiosity/engine/factors/rows/open_share.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
struct Monitor;

struct SunlitOptions {
    double error = .01; ///< standard error of a share that rays find [-]
    std::uint64_t seed = 1;
};

/// Returns the sunlit fraction of each patch; `sun` is the unit vector to the sun. The standard
/// error is 0 where the fraction is exact. A patch that faces away, or is seen edge-on, has 0. The
/// result has the same bytes for any number of threads; it is void if the monitor was interrupted.
[[nodiscard]] std::vector<OpenShare> sunlit_patches(const Vec3& sun, const Mesh& mesh,
                                                    const WideBvh& tree,
                                                    const SunlitOptions& options,
                                                    const Workers& workers, Monitor& monitor);

/// Returns whether the sun shines on the front of a point's facet.
[[nodiscard]] bool is_sunlit(const FactorPoint& point, const Vec3& sun, const Tracer& tracer);

} // namespace hemilux
