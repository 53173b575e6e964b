#pragma once
// A solution with its errors, which can be averaged with others that are more or less exact.

#include "radiosity/paper/solution/solution.h"

#include <vector>

namespace hemilux {

/// The radiosity B [W/m2] by patch, its variance [(W/m2)^2], and the light [W/m2] that may still be
/// missing. `left_to_chance` is the part of the variance that pairs add which were seldom looked
/// at, as guessed. `energy` says where the power went.
struct Estimate {
    std::vector<Vec3> radiosity, variance, left_to_chance, missing;
    double shared = 0;    ///< area times variance of all patches, as far as they err together
    EnergyBalance energy; ///< local units

    /// Becomes the mean with an independent estimate, which has the weight `share`. Variances fall
    /// in the mean; missing light does not.
    void join(const Estimate& other, double share) {
        const auto mean = [share](const auto& a, const auto& b) { return a + share * (b - a); };
        const auto both = [share](const auto& a, const auto& b) {
            return (1 - share) * (1 - share) * a + share * share * b;
        };
        for (std::size_t i = 0; i < radiosity.size(); ++i) {
            radiosity[i] = mean(radiosity[i], other.radiosity[i]);
            variance[i] = both(variance[i], other.variance[i]);
            left_to_chance[i] = both(left_to_chance[i], other.left_to_chance[i]);
            missing[i] = mean(missing[i], other.missing[i]);
        }
        shared = both(shared, other.shared);
        energy.absorbed = mean(energy.absorbed, other.energy.absorbed);
        energy.escaped = mean(energy.escaped, other.energy.escaped);
        energy.unshot = mean(energy.unshot, other.energy.unshot);
    }
};

} // namespace hemilux
