// Draws cosine-distributed directions. There is no #pragma once: see sobol.h.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

// These functions give sine and cosine of pi/4 t for |t| <= 1 by Taylor's series, whose first term
// left out is below half of the last bit.

inline double sine_of_eighths(double x2, double x) {
    double sum = 1.0 / 355687428096000; // 17!
    sum = sum * x2 - 1.0 / 1307674368000;
    sum = sum * x2 + 1.0 / 6227020800;
    sum = sum * x2 - 1.0 / 39916800;
    sum = sum * x2 + 1.0 / 362880;
    sum = sum * x2 - 1.0 / 5040;
    sum = sum * x2 + 1.0 / 120;
    sum = sum * x2 - 1.0 / 6;
    return sum * x2 * x + x;
}

inline double cosine_of_eighths(double x2) {
    double sum = 1.0 / 20922789888000; // 16!
    sum = sum * x2 - 1.0 / 87178291200;
    sum = sum * x2 + 1.0 / 479001600;
    sum = sum * x2 - 1.0 / 3628800;
    sum = sum * x2 + 1.0 / 40320;
    sum = sum * x2 - 1.0 / 720;
    sum = sum * x2 + 1.0 / 24;
    sum = sum * x2 - 0.5;
    return sum * x2 + 1.0;
}

inline void cosine(std::size_t count, const double* __restrict u, const double* __restrict v,
                   double* __restrict x, double* __restrict y, double* __restrict z) {
    constexpr double eighth = 0x1.921fb54442d18p-1; // of a turn: pi / 4
    for (std::size_t k = 0; k < count; ++k) {
        const double a = 2 * u[k] - 1, b = 2 * v[k] - 1;
        const bool wide = __builtin_fabs(a) > __builtin_fabs(b);
        const double r = wide ? a : b, other = wide ? b : a;
        const double angle = eighth * (other / (r == 0 ? 1.0 : r));
        const double s = r * sine_of_eighths(angle * angle, angle);
        const double c = r * cosine_of_eighths(angle * angle);
        x[k] = wide ? c : s;
        y[k] = wide ? s : c;
        const double z2 = 1 - r * r;
        z[k] = __builtin_sqrt(z2 > 0 ? z2 : 0.0);
    }
}

} // namespace hemilux::HEMILUX_KERNELS
