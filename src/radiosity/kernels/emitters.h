// How likely emitters are drawn (radiosity/emitter_choice.h). No #pragma once: see sobol.h.

#include "radiosity/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

inline double lesser(double a, double b) { return a < b ? a : b; }
inline double greater(double a, double b) { return a > b ? a : b; }

inline void weigh_emitters(const EmitterArrays& emitters, std::size_t count,
                           const EmitterReceiver& to, double* __restrict weights) {
    constexpr double pi = 0x1.921fb54442d18p+1;
    const double *cx = emitters.centre[0], *cy = emitters.centre[1], *cz = emitters.centre[2];
    const double *nx = emitters.normal[0], *ny = emitters.normal[1], *nz = emitters.normal[2];
    const double *area = emitters.area, *side = emitters.side;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = cx[k] - to.centre[0], y = cy[k] - to.centre[1], z = cz[k] - to.centre[2];
        const double r2 = x * x + y * y + z * z, r = __builtin_sqrt(r2);
        const double ahead = to.normal[0] * x + to.normal[1] * y + to.normal[2] * z;
        const double below = -(nx[k] * x + ny[k] * y + nz[k] * z);

        // As in may_see: a corner of each must lie in front of the other's plane.
        double highest = ahead, lowest = below; // of the centres
        for (std::size_t i = 0; i < 4; ++i) {
            const double height = to.normal[0] * (emitters.corner[i][0][k] - to.centre[0]) +
                                  to.normal[1] * (emitters.corner[i][1][k] - to.centre[1]) +
                                  to.normal[2] * (emitters.corner[i][2][k] - to.centre[2]);
            const double depth = nx[k] * (to.corner[i][0] - cx[k]) +
                                 ny[k] * (to.corner[i][1] - cy[k]) +
                                 nz[k] * (to.corner[i][2] - cz[k]);
            highest = greater(highest, height);
            lowest = greater(lowest, depth);
        }
        const double least = 1e-12 + 1e-7 * r;
        const bool may_see = (highest > least) & (lowest > least);

        const double nearest = greater(r - to.radius, 0.0);
        const double square = pi * r2 + area[k];
        const double excess = __builtin_sqrt(square / (pi * nearest * nearest + area[k]));
        const double least_cosine = (to.side + side[k]) * 0.5;
        const double cosines = r2 > 0 ? lesser(greater(ahead, least_cosine), r) *
                                            lesser(greater(below, least_cosine), r) / r2
                                      : 1.0;
        const double weight = emitters.light[k] * cosines * area[k] / square * excess;
        weights[k] = may_see ? weight : 0.0;
    }
}

inline void weigh_clusters(const ClusterArrays& clusters, std::size_t count,
                           const EmitterReceiver& to, double* __restrict weights) {
    constexpr double pi = 0x1.921fb54442d18p+1;
    const double *cx = clusters.centre[0], *cy = clusters.centre[1], *cz = clusters.centre[2];
    for (std::size_t k = 0; k < count; ++k) {
        const double x = cx[k] - to.centre[0], y = cy[k] - to.centre[1], z = cz[k] - to.centre[2];
        const double r2 = x * x + y * y + z * z, r = __builtin_sqrt(r2);
        const double reach = clusters.radius[k] + to.radius;
        const double height = to.normal[0] * x + to.normal[1] * y + to.normal[2] * z + reach;
        const double cosine = r > reach ? lesser(height / r, 1.0) : 1.0;
        const double area = pi * clusters.radius[k] * clusters.radius[k];
        const double nearest = greater(r - to.radius, 0.0), square = pi * r2 + area;
        const double weight = clusters.power[k] * cosine / square *
                              __builtin_sqrt(square / (pi * nearest * nearest + area));
        weights[k] = cosine > 0 ? weight : 0.0;
    }
}

} // namespace hemilux::HEMILUX_KERNELS
