#pragma once
// The distance of a solution's light, one value on each patch, from the light on the surfaces.
//
// At points x of the surfaces the light is gathered twice, independently: g1(x), g2(x). The gathers
// read light that walks from such points have made right (light_cache.h). So the mean over the area
// of
//     (g1 - B)(g2 - B)
// is the squared error of the solution, free of the noise of either gather. Points lie over the
// area, where the light is and where patches are small, all alike: a small bright face may hold
// most of the error. What is left once the known variance of each patch's value is taken off is the
// error of the division: what patches lack in detail, and what that has done to the light of
// others.

#include "bvh/tracer.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class StopFlag;
class Workers;
struct Solution;

/// An error relative to the reflected light, as estimated_error(): the RMS over area and channels,
/// with the weights of the solution, if it has any. If it is hardly known, `error` is nearly as
/// large as it may be. It is NaN if it is not known at all.
struct DivisionError {
    double error = std::numeric_limits<double>::quiet_NaN();
    double uncertainty = std::numeric_limits<double>::quiet_NaN(); ///< one sigma of `error`
    std::size_t points = 0;
    std::uint64_t rays = 0;

    /// Returns whether it is known to an eighth of itself, or surely below `negligible`.
    [[nodiscard]] bool is_known(double negligible) const {
        return uncertainty <= error / 8 || error + uncertainty <= negligible;
    }
};

struct DivisionErrorOptions {
    std::uint64_t seed = 1;
    /// Points are added until the error is known (DivisionError::is_known), or so many rays were
    /// traced; but there are always at least five hundred points.
    std::uint64_t max_rays = 1'000'000;
    double negligible = 0; ///< relative error [-]
    /// About what the error may be [-], so that the light which gathers read is learned as well as
    /// that needs from the beginning; 0: unknown.
    double expected = 0;
    /// The squared errors by patch [local area x (W/m2)^2], as far as they are known, or empty.
    /// Where they are large and count, more points are drawn.
    std::span<const double> square = {};
};

/// Returns the sum over patches of weight, area and reflected radiosity squared, to which errors
/// are relative. The square that errors of the division are relative to also has what slopes add.
[[nodiscard]] double reflected_square(const Mesh& mesh, const Solution& solution);

/// Returns the error of a solution, with a step at least, due to the division of the patches. If it
/// was interrupted, the error is not known.
[[nodiscard]] DivisionError division_error(const Mesh& mesh, const Tracer& tracer,
                                           const Solution& solution,
                                           const DivisionErrorOptions& options,
                                           const Workers& workers, const StopFlag& interrupted);

/// Returns for each patch the root mean square of the error of its light: within the patch, as far
/// as light_within_patches() finds it, and by its standard error. It is relative to that of the
/// reflected light over the whole surface, or over the target of the solution. The result is empty
/// if it was interrupted, and 0 where nothing is known or reflected.
[[nodiscard]] std::vector<double> patch_error_levels(const Mesh& mesh, const Tracer& tracer,
                                                     const Solution& solution, std::uint64_t seed,
                                                     const Workers& workers,
                                                     const StopFlag& interrupted);

} // namespace hemilux
