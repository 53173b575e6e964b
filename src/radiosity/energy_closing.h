#pragma once
// The balance of energy of a solution by stored or explicit transport, and its closing.
//
// The factors of such a solution come from counts, so that patches may receive a little more or
// less than was sent. Where it is well known how much is lost, all light that arrives is scaled by
// the one number that makes emitted = absorbed + escaped: in bright rooms an error of the whole is
// nearly all of the error. Else the light as it is tells more than the count of rays that were
// lost: what left and did not arrive was lost.

#include "radiosity/ray_counts.h"
#include "radiosity/sampled_form_factors.h"
#include "radiosity/solution.h"

#include <span>

namespace hemilux {

/// All by patch.
struct Transport {
    std::span<const double> area;
    std::span<const Vec3> emission, reflectance;
    std::span<const LostShare> lost;
    std::span<const double> rays; ///< that the lost share was found with; 0 where there were none
};

/// `direct` [W/m2 arriving] comes straight from emitters. All of it is what they sent less what was
/// lost; it is scaled to that where it is well known. In bright rooms an error of it would be the
/// error of the whole solution.
void scale_direct_light(const Transport& transport, std::span<Vec3> direct);

/// `incident` [W/m2 arriving] is what was solved for, B = E + rho incident; it may be scaled.
/// Powers in units of area times incident.
[[nodiscard]] EnergyBalance close_energy(const Transport& transport, std::span<Vec3> incident);

/// Whether light comes to an end at all. Where reflectances are 1 few rays may have found no way
/// out of the scene, and there is no solution with their factors.
[[nodiscard]] inline bool is_drained(const EnergyBalance& energy) {
    return !(energy.imbalance() >= .5);
}

/// Throws SolveError where they cannot be had.
void require_more_rays(bool may_have_more);

} // namespace hemilux
