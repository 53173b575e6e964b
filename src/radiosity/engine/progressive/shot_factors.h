#pragma once
// The form factors of all patches to one that shoots, for progressive radiosity. They are found
// anew for each shot, the more exactly the more light they carry (pair_factor.h), or by the
// shooter's hemicube (hemicube.h).

#include "parallel/workers.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/engine/factors/points/hemicube.h"
#include "radiosity/engine/progressive/shot_balance.h"
#include "radiosity/paper/solving/solver.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// The form factor from a receiver to the shooter.
struct ReceiverFactor : PairFactor {
    double at_risk = 0; ///< estimate of the factor, if it was left to chance whether to look
    /// The variance that this chance adds, as guessed before any ray. `variance` has it as
    /// measured: right on average, but 0 where nothing was traced.
    double left_to_chance = 0;
};

class ShotFactors {
  public:
    /// `mean_reflected` is the radiosity that the mean patch will reflect in the end [W/m2].
    ShotFactors(const SolverInput& input, double mean_reflected);

    /// Looks from all patches to the shooter, which shoots the radiosity `shot`. A receiver traces
    /// `rays_per_light` rays if the shot gives it as much light as the mean patch reflects; the
    /// others get rays in proportion. The factors are void if interrupted.
    void look(std::uint32_t shooter, const Vec3& shot, double rays_per_light, std::uint64_t seed);

    /// Finds the same as the shooter's hemicube shows it (Cohen, Chen, Wallace and Greenberg 1988):
    /// F_is = F_si A_s / A_i, for all patches, with the pixels that show i as hits. Returns what of
    /// the shot is lost; the rest arrives. The factors are void if interrupted.
    EscapeFraction look(const Hemicube& cube, std::uint32_t shooter);

    /// Returns the factors of the last shot, by receiver.
    [[nodiscard]] std::span<const ReceiverFactor> by_receiver() const { return by_receiver_; }
    /// Returns the share of that shot that arrives.
    [[nodiscard]] FactorSum sum() const;

  private:
    void guess();
    [[nodiscard]] bool is_receiver(std::uint32_t patch) const;
    [[nodiscard]] ReceiverFactor look_from(std::uint32_t receiver, const Vec3& shot,
                                           double rays_per_light, std::uint64_t seed) const;

    SolverInput input_;
    Workers workers_;
    double mean_reflected_, mean_area_ = 0;
    std::uint32_t shooter_ = 0;
    std::vector<double> rough_; ///< F_receiver,shooter as guessed
    double crowding_ = 1;       ///< what the guesses for all receivers sum up to, at least 1
    std::vector<ReceiverFactor> by_receiver_;
};

/// Black patches count as if they had this reflectance, since what they absorb must be known too.
inline constexpr double min_reflectance_of_receivers = .1;

} // namespace hemilux
