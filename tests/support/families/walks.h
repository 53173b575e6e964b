#pragma once
// The radiosity of a group of patches by walks from patch to patch, backward from the eye's side:
// the plainest estimator there is, to compare other references with. Slow; for tests.

#include "bvh/tracer.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdint>
#include <span>

namespace hemilux::test {

struct WalkResult {
    double mean = 0;           ///< of the reflected radiosity over the area of the group, channel 0
    double standard_error = 0; ///< of it
};

/// Each walk starts on a patch of the group, chosen by its area. A vertex of it is a random point
/// of a patch; the next one is a point of the patch that a cosine-distributed ray strikes, anywhere
/// on it, as the patch has one radiosity. The direct light of a vertex comes by one shadow ray to
/// one emitter, each as likely as any other; emission that a ray strikes does not count again.
[[nodiscard]] WalkResult walk(const Mesh& mesh, const Tracer& tracer,
                              std::span<const std::uint32_t> group, std::uint64_t walks,
                              std::uint64_t seed);

} // namespace hemilux::test
