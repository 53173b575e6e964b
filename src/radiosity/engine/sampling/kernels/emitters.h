// Estimates how likely emitters are drawn (radiosity/engine/emitters/emitter_choice.h). There is no
// #pragma once: see sobol.h.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

inline double lesser(double a, double b) { return a < b ? a : b; }
inline double greater(double a, double b) { return a > b ? a : b; }

inline void weigh_emitters(const EmitterArrays& emitters, std::size_t count,
                           const EmitterReceiver& to, double* __restrict weights,
                           double* __restrict found) {
    constexpr double pi = 0x1.921fb54442d18p+1;
    const double *cx = emitters.centre[0], *cy = emitters.centre[1], *cz = emitters.centre[2];
    const double *nx = emitters.normal[0], *ny = emitters.normal[1], *nz = emitters.normal[2];
    const double *area = emitters.area, *side = emitters.side;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = cx[k] - to.centre[0], y = cy[k] - to.centre[1], z = cz[k] - to.centre[2];
        const double r2 = x * x + y * y + z * z, r = __builtin_sqrt(r2);
        const double ahead = to.normal[0] * x + to.normal[1] * y + to.normal[2] * z;
        const double below = -(nx[k] * x + ny[k] * y + nz[k] * z);

        // The test is that of may_see: a corner of each must lie in front of the other's plane.
        double highest = ahead, lowest = below; // of the centres
        double min_ahead = ahead, min_below = below;
        for (std::size_t i = 0; i < 4; ++i) {
            const double height = to.normal[0] * (emitters.corner[i][0][k] - to.centre[0]) +
                                  to.normal[1] * (emitters.corner[i][1][k] - to.centre[1]) +
                                  to.normal[2] * (emitters.corner[i][2][k] - to.centre[2]);
            const double depth = nx[k] * (to.corner[i][0] - cx[k]) +
                                 ny[k] * (to.corner[i][1] - cy[k]) +
                                 nz[k] * (to.corner[i][2] - cz[k]);
            highest = greater(highest, height);
            lowest = greater(lowest, depth);
            min_ahead = lesser(min_ahead, height);
            min_below = lesser(min_below, depth);
        }
        const double least = 1e-12 + 1e-7 * r;
        const bool may_see = (highest > least) & (lowest > least);

        // No point of either is nearer to the other than to its plane.
        const double nearest = greater(greater(r - to.radius, 0.0), greater(min_ahead, min_below));
        const double square = pi * r2 + area[k];
        const double excess = __builtin_sqrt(square / (pi * nearest * nearest + area[k]));
        const double min_cosine = (to.side + side[k]) * 0.5;
        const double cosines = r2 > 0 ? lesser(greater(ahead, min_cosine), r) *
                                            lesser(greater(below, min_cosine), r) / r2
                                      : 1.0;
        const double light = emitters.light[k], factor = cosines * area[k] / square;
        const double weight = light * factor * excess, square_found = light * light * factor;
        weights[k] = may_see ? weight : 0.0;
        found[k] = may_see ? square_found : 0.0;
    }
}

inline void weigh_clusters(const ClusterArrays& clusters, std::size_t count,
                           const EmitterReceiver& to, double* __restrict weights,
                           double* __restrict found) {
    constexpr double pi = 0x1.921fb54442d18p+1;
    const double *cx = clusters.centre[0], *cy = clusters.centre[1], *cz = clusters.centre[2];
    for (std::size_t k = 0; k < count; ++k) {
        const double x = cx[k] - to.centre[0], y = cy[k] - to.centre[1], z = cz[k] - to.centre[2];
        const double r2 = x * x + y * y + z * z, r = __builtin_sqrt(r2);
        const double reach = clusters.radius[k] + to.radius;
        const double height = to.normal[0] * x + to.normal[1] * y + to.normal[2] * z + reach;
        const double cosine = r > reach ? lesser(height / r, 1.0) : 1.0;
        const double square = pi * (r2 + clusters.radius[k] * clusters.radius[k]);
        // The gap is that of one emitter of the cluster, which is drawn by its power, to the points
        // that it is nearest to.
        const double gap = greater(r - to.radius, height - reach), radius = clusters.radius[k];
        const double nearest = gap > 2 * radius ? gap : greater(gap - radius, 0.0);
        const double excess = __builtin_sqrt(square / (pi * nearest * nearest + clusters.area[k]));
        const double light = clusters.power[k] * cosine / square;
        weights[k] = cosine > 0 ? light * excess : 0.0;
        found[k] = cosine > 0 ? light * clusters.light[k] : 0.0;
    }
}

} // namespace hemilux::HEMILUX_KERNELS
