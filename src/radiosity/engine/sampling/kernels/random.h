// Draws random numbers by their place, and directions into cells. There is no #pragma once: see
// sobol.h.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

/// Computes pcg4d of Jarzynski and Olano (2020, "Hash functions for GPU rendering").
inline void random(const RandomKeys& keys, std::size_t count, std::uint32_t attempt,
                   double* __restrict a, double* __restrict b, double* __restrict c,
                   double* __restrict d) {
    const std::uint32_t *low = keys.low, *high = keys.high, *number = keys.number;
    const auto uniform = [](std::uint32_t w) { return (static_cast<double>(w) + 0.5) * 0x1p-32; };
    for (std::size_t k = 0; k < count; ++k) {
        std::uint32_t x = low[k] * 1664525u + 1013904223u, y = high[k] * 1664525u + 1013904223u;
        std::uint32_t z = number[k] * 1664525u + 1013904223u;
        std::uint32_t w = attempt * 1664525u + 1013904223u;
        x += y * w, y += z * x, z += x * y, w += y * z;
        x ^= x >> 16, y ^= y >> 16, z ^= z >> 16, w ^= w >> 16;
        x += y * w, y += z * x, z += x * y, w += y * z;
        a[k] = uniform(x);
        b[k] = uniform(y);
        c[k] = uniform(z);
        d[k] = uniform(w);
    }
}

inline void in_cells(const CellShapes& cells, std::size_t count, const std::int32_t* cell,
                     const double* __restrict u, const double* __restrict v, double* __restrict x,
                     double* __restrict y, double* __restrict z, std::uint32_t* __restrict inside) {
    const auto of = [&](unsigned part, std::int32_t at) { return cells.part[part][at]; };
    for (std::size_t k = 0; k < count; ++k) {
        const std::int32_t c = cell[k];
        // The second half is folded onto the first.
        const double half = of(CellShapes::half, c), fold = u[k] + v[k] > 1 ? half : 0.0;
        const double s = __builtin_fabs(fold - u[k]), t = __builtin_fabs(fold - v[k]);
        constexpr unsigned corner = CellShapes::corner, edges = CellShapes::edges;
        const double px = of(corner, c) + s * of(edges, c) + t * of(edges + 2, c);
        const double py = of(corner + 1, c) + s * of(edges + 1, c) + t * of(edges + 3, c);
        const double z2 = 1.0 - (px * px + py * py);
        const double pz = __builtin_sqrt(z2 > 0 ? z2 : 0.0);
        double least = z2 > 0 ? 1.0 : -1.0;
        for (unsigned side = 0; side < 9; side += 3) {
            const double height = of(side, c) * px + of(side + 1, c) * py + of(side + 2, c) * pz;
            least = height < least ? height : least;
        }
        x[k] = px;
        y[k] = py;
        z[k] = pz;
        inside[k] = least >= 0 ? 1 : 0;
    }
}

} // namespace hemilux::HEMILUX_KERNELS
