#pragma once
// Finds the squared error of a solution at points of the surfaces, by gathers there. A surface must
// reflect some light (surface_square()).

#include "radiosity/light/light_error/division_error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hemilux {

struct LightSource;

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

    /// Adds an error that does not depend on this one.
    void add(const SquaredError& other) {
        square += other.square;
        sigma = std::hypot(sigma, other.sigma);
        rays += other.rays;
    }
};

/// Returns reflected_square() and the square of what the solution has within patches. With that of
/// the error it is the square of the light itself.
[[nodiscard]] double surface_square(const Mesh& mesh, const Solution& solution);

/// Finds the error of the values within patches, by gathers there.
[[nodiscard]] SquaredError error_within_patches(const LightSource& light, const OtherError& other,
                                                const DivisionErrorOptions& options,
                                                const Workers& workers,
                                                const StopFlag& interrupted);
/// Finds the error of the light that arrives from other patches.
[[nodiscard]] SquaredError error_of_spread(const LightSource& light,
                                           const DivisionErrorOptions& options,
                                           const Workers& workers, const StopFlag& interrupted);
/// Finds the error of gathered light, as pictures and --points have it. `reads_near` is as in
/// spread_error().
[[nodiscard]] SquaredError error_of_gathers(const LightSource& light, bool reads_near,
                                            const DivisionErrorOptions& options,
                                            const Workers& workers, const StopFlag& interrupted);

} // namespace hemilux
