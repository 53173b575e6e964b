#pragma once
// A pass of progressive radiosity. It begins with all light in the emitters and ends when hardly
// any is left to be shot.
//
// B has three errors. First, each pair of patches has an error of its own, and the spread of its
// points says how large it is. A shooter passes its error on with its light, which matters between
// patches that nearly touch. Second, all that a shot brings has a common error, together with all
// that later shots make of it. This error is taken to be spread evenly, as the ambient term of
// Cohen et al. (1988) spreads light. Third, what is unshot will add to B, by up to the ambient term
// or in proportion to the light that is there.

#include "geometry/compensated_sum.h"
#include "radiosity/engine/progressive/estimate.h"
#include "radiosity/engine/progressive/progressive_options.h"
#include "radiosity/engine/progressive/shot_balance.h"
#include "radiosity/engine/progressive/shot_factors.h"
#include "radiosity/engine/sampling/largest_first.h"
#include "radiosity/paper/solving/solver.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class ProgressivePass {
  public:
    explicit ProgressivePass(const SolverInput& input);

    /// Starts again from the emitters. A receiver traces `rays_per_light` shadow rays in a shot
    /// that gives it as much light as the mean patch reflects in the end. In other shots its rays
    /// are in proportion to the light.
    void begin(double rays_per_light);
    /// Shoots from the patch with the most unshot power; `step` is for messages. The pass is void
    /// if interrupted.
    void shoot(std::uint32_t step);
    [[nodiscard]] bool is_done() const;
    /// Returns the solution and its errors, after the last shot.
    [[nodiscard]] Estimate estimate() const;

    [[nodiscard]] const Vec3& emitted() const { return emitted_; } ///< power, local units
    // These are numbers of all passes together: hits by patch, points that were looked from, and
    // rays.
    [[nodiscard]] std::span<const std::uint64_t> hits() const { return hits_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    /// The light that was reflected so far, over all patches.
    struct Reflected {
        Vec3 power{0.0};
        Vec3 gain{0.0}; ///< what all reflections add to light where this is, relative to it
    };

    [[nodiscard]] ShotShares look(std::uint32_t shooter, const Vec3& shot);
    void rank(std::uint32_t patch);
    [[nodiscard]] double unshot_power(std::uint32_t patch) const;
    [[nodiscard]] ShotRays look_for_losses(std::uint32_t shooter, const Vec3& shot);
    void receive(const Vec3& shot, const Vec3& shot_variance, const ShotShares& shares);
    void note_power_variance(const Vec3& shot, const ShotShares& shares);
    /// Returns the light reflected so far, with a mean reflectance of at most `most`.
    [[nodiscard]] Reflected reflected(double most) const;
    [[nodiscard]] Vec3 ambient() const;
    [[nodiscard]] Vec3 power_unshot() const;

    SolverInput input_;
    ProgressiveOptions options_;
    double reflecting_area_ = 0;
    Vec3 mean_reflectance_{0.0}; ///< mean over that, by area
    Vec3 emitted_{0.0};
    std::vector<Vec3> radiosity_, unshot_; ///< B and dB
    LargestFirst brightest_;               ///< unshot power
    std::vector<Vec3> variance_;           ///< variance of B by sampling, with what shooters err by
    std::vector<Vec3> unshot_variance_;    ///< the part of it that is still to be shot
    std::vector<Vec3> left_to_chance_;     ///< part of that, by pairs that were seldom looked at
    Vec3 power_variance_{0.0};             ///< variance of the power that all shots have brought
    CompensatedSum<Vec3> absorbed_, escaped_, by_chance_; ///< power, local units
    ShotBalance balance_;
    ShotFactors factors_;
    std::optional<Hemicube> hemicube_; ///< view that shows the factors, where they are not sampled
    double rays_per_light_ = 0;
    std::vector<std::uint64_t> hits_;
    std::uint64_t points_ = 0, rays_ = 0, shots_ = 0;
};

} // namespace hemilux
