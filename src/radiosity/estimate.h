#pragma once
// A solution with its variance, which can be averaged with others of different worth.

#include "radiosity/solution.h"

#include <vector>

namespace hemilux {

/// By patch: B and its variance; and where the power went.
struct Estimate {
    std::vector<Vec3> radiosity, variance;
    EnergyBalance energy; ///< local units

    /// Mean with an independent one; `share`: of the other.
    void join(const Estimate& other, double share) {
        const auto mean = [share](const Vec3& a, const Vec3& b) { return a + share * (b - a); };
        for (std::size_t i = 0; i < radiosity.size(); ++i) {
            radiosity[i] = mean(radiosity[i], other.radiosity[i]);
            variance[i] =
                (1 - share) * (1 - share) * variance[i] + share * share * other.variance[i];
        }
        energy.absorbed = mean(energy.absorbed, other.energy.absorbed);
        energy.escaped = mean(energy.escaped, other.energy.escaped);
        energy.unshot = mean(energy.unshot, other.energy.unshot);
    }
};

} // namespace hemilux
