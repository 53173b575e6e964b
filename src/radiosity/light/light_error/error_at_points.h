#pragma once
// Finds the squared error of a solution at points of the surfaces, by gathers there. A surface must
// reflect some light (surface_square()).

#include "radiosity/light/light_error/division_error.h"

#include <cstddef>
#include <cstdint>

namespace hemilux {

struct LightSource;
class SurfaceLight;

/// The squared error that is not due to the division, relative to the square of the patches' values
/// as all else.
struct OtherError {
    double square = 0, scatter = 0;
};

/// A squared error, relative to the square of what the solution has on the surfaces.
struct SquaredError {
    double square = 0; ///< an estimate, which may be negative
    double sigma = 0;  ///< one, of `square`
    std::size_t points = 0;
    std::uint64_t rays = 0;
};

/// Returns reflected_square() and the square of what the solution has within patches. With that of
/// the error it is the square of the light itself.
[[nodiscard]] double surface_square(const Mesh& mesh, const Solution& solution);

/// Finds the error of the values within patches, by gathers there that read `read`.
[[nodiscard]] SquaredError error_within_patches(const LightSource& light, const SurfaceLight& read,
                                                const OtherError& other,
                                                const DivisionErrorOptions& options,
                                                const Workers& workers,
                                                const StopFlag& interrupted);

} // namespace hemilux
