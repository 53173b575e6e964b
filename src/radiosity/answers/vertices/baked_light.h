#pragma once
// The light that a mesh file holds, by vertex.

#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/vertices/smooth.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/scene/mesh.h"

#include <vector>

namespace hemilux {

/// The kinds of light.
enum class Bake {
    radiosity,  ///< B, what a surface sends: what pictures show
    irradiance, ///< (B - E) / rho, what arrives: for viewers that multiply by textures of their own
    indirect ///< what arrives by a reflection (indirect_light.h): for those that add emitters too
};
/// Returns its name, as --bake and files have it.
[[nodiscard]] const char* name_of(Bake bake);

/// Returns (B - E) / rho [W/m2]. Where a channel reflects nothing, its irradiance is not known and
/// 0 stands for it.
[[nodiscard]] Vec3 irradiance_of(const Material& material, const Vec3& radiosity);

/// Returns the radiosity or irradiance of each class of corners, smoothed [W/m2].
[[nodiscard]] std::vector<Vec3> baked_light(const Mesh& mesh, const CornerClasses& classes,
                                            const PatchLight& light, Bake bake);

/// Returns the exposure that auto_exposure() chooses for a picture in which each surface covers as
/// much as it has area. Suns and skies do not count. `of_class` is by class of corners.
[[nodiscard]] double auto_exposure(const Mesh& mesh, const CornerClasses& classes,
                                   std::span<const Vec3> of_class);

/// The light of the vertices of a file, and how it is shown.
struct VertexLight {
    std::vector<Vec3> of_class; ///< [W/m2]
    Bake bake = Bake::radiosity;
    Display display = {};
};

} // namespace hemilux
