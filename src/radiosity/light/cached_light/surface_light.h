#pragma once
// The light that points of surfaces send, as gathers read it: that of a solution on patches, with
// what walks found besides in small cells (irradiance_cells.h), and with the colours of textures.

#include "radiosity/light/cached_light/patch_light.h"

#include <cstdint>

namespace hemilux {

class IrradianceCells;
class Mesh;

class SurfaceLight {
  public:
    /// `light` is what patches send. All that is referred to must outlive this object; without
    /// cells the light of patches is taken for that of their points.
    SurfaceLight(const Mesh& mesh, PatchLight light, const IrradianceCells* cells = nullptr)
        : mesh_(mesh), patches_(light), cells_(cells) {}

    [[nodiscard]] const PatchLight& of_patches() const { return patches_; }
    /// What is known of the irradiance of a point [W/m2].
    struct Irradiance {
        Vec3 value, of_patch; ///< with what walks found, and without
        /// The distance below which it is not read (local units): what it is the mean of would be
        /// seen under a wide angle, with its edges and its noise.
        double near;
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
