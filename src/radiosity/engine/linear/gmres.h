#pragma once
// Solves linear systems with a non-symmetric matrix that is known by its product with a vector
// only: GMRES (Saad and Schultz 1986) with modified Gram-Schmidt and restarts. The residual never
// grows. A few slow modes, such as the mean of a very reflective room, cost a few iterations and no
// more. Rooms in a row have as many slow modes as there are rooms. Where a cycle gains too little
// for the number of iterations, the next ones keep twice as many vectors.

#include <cstddef>
#include <functional>
#include <vector>

namespace hemilux {

struct GmresOptions {
    double tolerance = 1e-12;      ///< bound of |b - A x| / |b|
    std::size_t restart = 40;      ///< vectors kept at first; more: fewer iterations, more memory
    std::size_t max_restart = 640; ///< vectors kept at most
    std::size_t max_iterations = 2000; ///< the products with A
};

struct GmresResult {
    double residual = 0; ///< |b - A x| / |b|, computed anew at the end
    std::size_t iterations = 0;
    /// The residual is within the tolerance, or rounding errors are all that is left of it.
    bool converged = true;
};

/// Computes y = A x; both have the same length.
using LinearMap = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

/// Improves x, which is the first guess, until the residual is small enough or cannot be made
/// smaller, or the iterations are used up.
[[nodiscard]] GmresResult gmres(const LinearMap& multiply, const std::vector<double>& b,
                                std::vector<double>& x, const GmresOptions& options = {});

} // namespace hemilux
