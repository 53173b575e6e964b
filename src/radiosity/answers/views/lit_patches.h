#pragma once
// Which patches are lit, beside the light that most of a scene has.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

class Mesh;

struct LitPatches {
    /// By patch: 0 for dark ones and for suns and skies, 1 for those that reflect half of the usual
    /// level or more. Four fifths of the reflected power come from patches above that level. What
    /// patches emit does not count; one that emits most of its light has 0.2 at most. Where nothing
    /// is reflected, all near patches have 1.
    std::vector<float> weight;
    std::vector<std::uint32_t> brightest; ///< some patches, drawn in proportion to reflected power
};

/// Returns what patches reflect [W/m2, the sum of the channels], 0 for suns and skies. `radiosity`
/// [W/m2] has one value per patch.
[[nodiscard]] std::vector<double> reflected_light(const Mesh& mesh,
                                                  std::span<const Vec3> radiosity);

/// `radiosity` [W/m2] has one value per patch. All emission may be multiplied by a number: then the
/// result is the same.
[[nodiscard]] LitPatches lit_patches(const Mesh& mesh, std::span<const Vec3> radiosity);

} // namespace hemilux
