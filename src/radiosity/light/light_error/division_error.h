#pragma once
// The distance of a solution's light, one value on each patch, from the light on the surfaces.
//
// At points x of the surfaces the light is gathered twice, independently: g1(x), g2(x). Each is
// right on average for the light that the solution sends, so the mean over the area of
//     (g1 - B)(g2 - B)
// is the squared error of the solution, free of the noise of either gather. Points lie over the
// area, where the light is and where patches are small, all alike: a small bright face may hold
// most of the error. It holds what the patches lack in detail and the noise of each patch's own
// value; the latter is known and taken off. It does not hold the error of the light that the
// solution sends (Lischinski, Smits and Greenberg 1994 bound that part). In most rooms that is
// smaller by a reflection. In bright ones it is the larger part, so it is measured too.
//
// What has spread is T (b - B) with T one reflection and b the light. Patches send their means M
// on, so b - M is r + T r + ... with the residual r(y) = g(y) - M of a gather that reads M. The
// mean of r over a patch is the error of its value, which is that of sampling. The rest, r(y) -
// r(y') with y' uniform on the patch of y, is the error of the division. So paths go on from point
// to point by the rays of gathers. Each vertex y adds that difference by one ray and one shadow ray
// of the same random numbers from y and from y'. Its noise falls with the size of patches.

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
    /// The squared errors by patch [local area x (W/m2)^2], as far as they are known, or empty.
    /// Where they are large and count, more points are drawn.
    std::span<const double> square = {};
};

/// Returns the error, due to the division of patches, of light that is gathered from the solution,
/// as pictures and --points show it: what has spread. With `reads_near`, gathers read each patch
/// that a ray meets, as those of pictures do. If it was interrupted, the error is not known.
[[nodiscard]] DivisionError spread_error(const Mesh& mesh, const Tracer& tracer,
                                         const Solution& solution, bool reads_near,
                                         const DivisionErrorOptions& options,
                                         const Workers& workers, const StopFlag& interrupted);
/// Returns the whole error of gathered light: `spread`, and what a reflection is assumed to leave
/// of the error of sampling.
[[nodiscard]] DivisionError gathered_error(const DivisionError& spread, const Mesh& mesh,
                                           const Solution& solution);

/// Returns the sum over patches of weight, area and reflected radiosity squared, to which errors
/// are relative. The square that errors of the division are relative to also has what slopes add.
[[nodiscard]] double reflected_square(const Mesh& mesh, const Solution& solution);

/// Returns the error of a solution, with a step at least, due to the division of the patches. One
/// part is within them, by gathers there except for the known variance of its values. The other is
/// what has spread to others; they do not depend on each other. If it was interrupted, the error is
/// not known.
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
