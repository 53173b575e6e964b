#pragma once
// How far a gathered picture is from the light that its rays read: by noise, and by what lies
// between the points at which it was gathered.

#include "io/pictures/camera.h"
#include "io/pictures/image.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/light/cached_light/surface_light.h"
#include "radiosity/paper/scene/varying_colours.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Workers;

/// An error relative to the reflected light that the picture shows: RMS over pixels and channels.
struct PictureError {
    double error = 0;
    double uncertainty = 0; ///< one sigma of `error`
    /// What 95 of 100 parts of the picture are within, relative to the light there [-].
    double local = 0;
    std::uint64_t rays = 0;
};

/// Gathers the light at random pixels once more, twice independently, with many rays. The mean
/// product of both differences from the picture is its squared error, free of their noise. Pixels
/// on edges are left out. About so many pixels are judged, one in each of equal parts of the
/// picture.
[[nodiscard]] PictureError picture_error(const Mesh& mesh, const Tracer& tracer,
                                         const SurfaceLight& light, const CameraRays& camera,
                                         const Image& picture, std::size_t pixels,
                                         std::uint64_t seed, const Workers& workers);

/// A pixel that is judged, by what it shows at places in it.
struct JudgedPixel {
    struct Place {
        SurfacePoint at;
        Colours colours;
    };
    /// Those of both estimates, half for each; one place stands for all. Empty: it is not judged.
    std::vector<Place> places;
    Vec3 shown; ///< its light [W/m2]
};

/// Does the same for pixels that were chosen. With `only_reflected` they show no light that arrives
/// straight from where it is emitted.
[[nodiscard]] PictureError error_of_pixels(const Mesh& mesh, const Tracer& tracer,
                                           const SurfaceLight& light,
                                           std::span<const JudgedPixel> pixels, std::uint64_t seed,
                                           bool only_reflected, const Workers& workers);

} // namespace hemilux
