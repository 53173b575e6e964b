#include "radiosity/light/cached_light/surface_light.h"

#include "geometry/numeric.h"
#include "radiosity/light/cached_light/irradiance_cells.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>

namespace hemilux {
namespace {

/// The distances below which light is not read, in sides of the square of which it is the mean:
/// with what walks found, and of patches alone, which take it or leave it as it is.
constexpr double near_of_cells = 1.5, near_of_patches = .5;

} // namespace

SurfaceLight::Irradiance SurfaceLight::irradiance(std::uint32_t patch, const Vec3& point) const {
    const Material& mean = mesh_.material(patch);
    const Vec3 reflected = radiosity_at(mesh_, patches_, patch, point) - mean.emission;
    const Vec3 of_patch = ratio_or_zero(reflected, mean.reflectance);
    if (!cells_)
        return {of_patch, of_patch, near_of_patches * std::sqrt(mesh_.patches()[patch].area)};
    const IrradianceCells::Known known = cells_->at(patch, point);
    return {of_patch + known.residual, of_patch, near_of_cells * known.side};
}

} // namespace hemilux
