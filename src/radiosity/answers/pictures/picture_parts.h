#pragma once
// The parts of a picture for which its light is learned and judged.

#include "radiosity/answers/views/camera_rays.h"
#include "radiosity/light/cached_light/light_cache.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Workers;

/// Returns parts spread evenly over a picture of this size [pixels]: each of them is a few pixels
/// near a random one that show the same side of a facet. Where a pixel shows nothing that reflects
/// there is no part.
[[nodiscard]] std::vector<TargetPart> picture_parts(const Mesh& mesh, const Tracer& tracer,
                                                    const CameraRays& camera, int width, int height,
                                                    std::uint64_t seed, const Workers& workers);

} // namespace hemilux
