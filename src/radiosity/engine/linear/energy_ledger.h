#pragma once
// Keeps the energy ledger of a solution by stored or explicit transport: emitted = absorbed +
// escaped.
//
// Counts of rays estimate how much of the light of a patch is lost: leaves the scene, or falls on
// backs of faces. A share that was counted as none or as all is not known for certain. Its variance
// is that of a Beta distribution that has seen the counts (Laplace's rule of succession), never 0.

#include "radiosity/engine/factors/rows/escape_fraction.h"
#include "radiosity/paper/solution/solution.h"

#include <cstdint>
#include <optional>
#include <span>

namespace hemilux {

struct SolverInput;

/// The known properties of the transport, all by patch.
struct Transport {
    std::span<const double> area;      ///< local units
    std::span<const Vec3> emission;    ///< [W/m2 leaving]
    std::span<const Vec3> reflectance; ///< [-]
    std::span<const EscapeFraction> lost;
    std::span<const double> rays; ///< rays that the escape fraction was found with; 0: none
    bool closed = false;          ///< no ray can be lost, as the geometry proves
    /// The power that lights without extent send, and what of it leaves the scene or falls on backs
    /// of faces [power].
    Vec3 sent_by_points{0.0}, escaped_of_points{0.0}, left_behind_of_points{0.0};
};

/// Scales `direct` [W/m2 arriving], which comes straight from emitters. Its sum over all patches is
/// known twice. One value comes from `direct` itself, whose power has the `variance` [power^2, by
/// channel]. The other is what the emitters sent less what was lost of it. The light is scaled to
/// the mean of both, each weighted by the inverse of its variance, and never to more than was sent.
/// So light that arrived is not discarded because the few rays of an emitter all missed.
void scale_direct_light(const Transport& transport, const Vec3& variance, std::span<Vec3> direct);

/// Returns the power of `direct` over all patches [area times W/m2].
[[nodiscard]] Vec3 power_arriving(const Transport& transport, std::span<const Vec3> direct);

/// Returns where the power of `incident` [W/m2 arriving] goes, with B = E + rho incident: power
/// that was emitted and not absorbed was lost. Powers are in units of area times incident.
[[nodiscard]] EnergyBalance balance_energy(const Transport& transport,
                                           std::span<const Vec3> incident);

/// Does the same for factors that may make or lose energy, as those of `matrix`. Where it is well
/// known how much is lost, compared with what is absorbed, `incident` is first scaled so that
/// emitted = absorbed + escaped.
[[nodiscard]] EnergyBalance close_energy(const Transport& transport, std::span<Vec3> incident);

/// Searches for a way out within a step whose rays have found none: each try traces more rays, up
/// to a limit.
class SearchForWayOut {
  public:
    explicit SearchForWayOut(const SolverInput& input);
    /// Returns whether the bounces of the light end. Where reflectances are 1 few rays may have
    /// found no way out of the scene. Then the system with their factors has no solution, or one
    /// that is not finite.
    [[nodiscard]] bool is_drained(const EnergyBalance& energy) const {
        const double imbalance = energy.imbalance();
        return perfect_ ? imbalance < .5 : !(imbalance >= .5);
    }
    /// Call it after a try that has failed, with the rays that the solver has traced so far. Throws
    /// SolveError if there may be no more rays, if the last try had no more, and at the limit.
    void go_on(std::uint64_t traced, bool may_have_more);

  private:
    bool perfect_ = false; ///< some reflectance is 1
    double most_;          ///< rays
    std::optional<std::uint64_t> traced_;
};

} // namespace hemilux
