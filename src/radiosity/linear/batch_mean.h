#pragma once
// The mean of the solutions of independent batches of rays, and how they spread about it.

#include "geometry/vector.h"

#include <span>
#include <vector>

namespace hemilux {

struct BatchMean {
    std::vector<Vec3> radiosity; ///< by patch [W/m2]
    std::vector<Vec3> variance;  ///< of that mean, by patch and channel [(W/m2)^2]
    std::vector<double>
        products; ///< as effective_freedom() (error_spread.h) takes them, weighted by area
};

/// `batches[r][i]` is the radiosity of patch i by batch r; `area` is by patch. There are two
/// batches at least.
[[nodiscard]] BatchMean mean_of_batches(std::span<const std::vector<Vec3>> batches,
                                        std::span<const double> area);

} // namespace hemilux
