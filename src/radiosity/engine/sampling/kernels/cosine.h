// Draws cosine-distributed directions. There is no #pragma once: see sobol.h.

#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/paper/sampling/concentric_map.h"

namespace hemilux::HEMILUX_KERNELS {

inline void cosine(std::size_t count, const double* __restrict u, const double* __restrict v,
                   double* __restrict x, double* __restrict y, double* __restrict z) {
    for (std::size_t k = 0; k < count; ++k)
        concentric_direction(u[k], v[k], x[k], y[k], z[k]);
}

} // namespace hemilux::HEMILUX_KERNELS
