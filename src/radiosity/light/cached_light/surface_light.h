#pragma once
// The light that points of surfaces send, as gathers read it: that of a solution on patches, with
// what walks found besides in small cells (irradiance_cells.h), and with the colours of textures.

#include "radiosity/light/cached_light/patch_light.h"

#include <cstdint>

namespace hemilux {

class IrradianceCells;
class Mesh;

/// Returns whether a point at a distance is so near that its irradiance is not taken for the mean
/// over a square of this side, which would be seen under a wide angle.
[[nodiscard]] inline bool is_near(double distance, double side) {
    constexpr double sides = 1.5;
    return distance < sides * side;
}

class SurfaceLight {
  public:
    /// `light` is what patches send. All that is referred to must outlive this object; without
    /// cells the light of patches is taken for that of their points.
    SurfaceLight(const Mesh& mesh, PatchLight light, const IrradianceCells* cells = nullptr)
        : mesh_(mesh), patches_(light), cells_(cells) {}

    [[nodiscard]] const PatchLight& of_patches() const { return patches_; }
    /// What is known of the irradiance of a point [W/m2], and the side of the square for which it
    /// is the mean (local units).
    struct Irradiance {
        Vec3 value, of_patch; ///< with what walks found, and without
        double side;
    };
    /// Returns that of a point (local frame) of a patch. It is 0 in channels that the patch does
    /// not reflect, unless walks found any.
    [[nodiscard]] Irradiance irradiance(std::uint32_t patch, const Vec3& point) const;

  private:
    const Mesh& mesh_;
    PatchLight patches_;
    const IrradianceCells* cells_;
};

} // namespace hemilux
