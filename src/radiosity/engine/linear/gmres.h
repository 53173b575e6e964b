#pragma once
// Solves linear systems with a non-symmetric matrix that is known by its product with a vector
// only: GMRES (Saad and Schultz 1986) with modified Gram-Schmidt and restarts. The residual never
// grows. A few slow modes, such as the mean of a very reflective room, cost a few iterations and no
// more.

#include <cstddef>
#include <functional>
#include <vector>

namespace hemilux {

struct GmresOptions {
    double tolerance = 1e-12; ///< of |b - A x| / |b|
    std::size_t restart = 40; ///< vectors kept; more: fewer iterations, more memory
    std::size_t most = 2000;  ///< iterations at most
};

struct GmresResult {
    double residual = 0; ///< |b - A x| / |b|, computed anew at the end
    std::size_t iterations = 0;
};

/// Computes y = A x; both have the same length.
using LinearMap = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

/// Improves x, which is the first guess, until the residual is small enough or cannot be made
/// smaller.
GmresResult gmres(const LinearMap& multiply, const std::vector<double>& b, std::vector<double>& x,
                  const GmresOptions& options = {});

} // namespace hemilux
