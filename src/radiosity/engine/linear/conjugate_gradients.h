#pragma once
// Applies the method of conjugate gradients (Hestenes and Stiefel 1952) to the radiosity equation.
//
// The light that arrives, h = d + F rho h, has the matrix I - F rho. It is self-adjoint and
// positive in the inner product with the weights A rho if A_i F_ij is symmetric and no row sums to
// more than 1. All three channels go in step, so that F is read once for all.
//
// These iterations lessen the residual where the light is bright first. Dark patches, which are to
// be solved to their own scale, come last and would need many more. So patches that are solved
// rest: when they are half of the lit ones, the iterations begin anew for the others, with the
// light of those at rest as it is. Rows of patches at rest are not read. At the end the residual of
// all is computed, and where what other patches changed is too much the iterations go on with all.

#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <span>
#include <vector>

namespace hemilux {

struct GradientsResult {
    int iterations = 0;
    double residual = 0;   ///< residual of the worst channel, relative to the light as below [-]
    bool converged = true; ///< false where the iterations ended at their limit
};

/// Solves h = d + F rho h, the light that arrives [W/m2] by patch, from the guess in `h`; areas are
/// local.
///
/// The iterations end when the residual is below `tolerance` in each channel. It is relative to the
/// light at the same patch, as root mean square over the area that is lit. So a faint room beside a
/// bright one is solved to its own scale. They also end at a limit, and when interrupted; h is void
/// then.
[[nodiscard]] GradientsResult
solve_by_gradients(const ExchangeMatrix& factors, std::span<const double> area,
                   std::span<const Vec3> reflectance, std::span<const Vec3> d, std::vector<Vec3>& h,
                   const Workers& workers, double tolerance, const StopFlag* interrupted = nullptr);

} // namespace hemilux
