#pragma once
// What every method delivers: radiosity per patch and how far off it may be.

#include "geometry/vector.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Where the light of a solution goes, per channel [W]: emitted = absorbed + escaped + unshot.
struct EnergyBalance {
    Vec3 emitted{0.0};
    Vec3 absorbed{0.0}; ///< by patches and by backs of one-sided faces
    Vec3 escaped{0.0};
    /// Power that leaves patches and was not sent on: what is still to be shot, or what chance has
    /// left; negative where it sent more than there was, and 0 on average.
    Vec3 unshot{0.0};

    /// What is missing, or too much, as a share of what is emitted; the largest of the channels. 0
    /// where nothing is emitted.
    [[nodiscard]] double imbalance() const;
};

/// How the radiosity of a patch changes along the axes x and y of Frame::from_normal() of its
/// normal [W/m2 per unit of the local frame].
struct Slope {
    Vec3 x{0.0}, y{0.0};
};

struct Solution {
    std::vector<Vec3> radiosity; ///< B per patch [W/m2 leaving], own emission included
    /// By patch: its light is a linear function whose mean is B. Empty: B everywhere on it.
    std::vector<Slope> slope = {};
    std::vector<Vec3> standard_error; ///< of B [W/m2]; NaN before two steps
    std::vector<std::uint64_t> hits;  ///< energy rays that struck each patch
    /// Sum over patches and channels of area times the variance of B, where that is known better
    /// than from standard_error, which is on the safe side where few rays arrive.
    std::optional<double> variance;
    /// The part of that sum by which all light of a part of the scene is off together.
    double variance_of_level = 0;
    /// Degrees of freedom from which that part is known: infinite where it was found by counting
    /// and not from the spread of a few samples.
    double level_freedom = std::numeric_limits<double>::infinity();
    /// The same sum for what no ray may have seen so far, by the rule of three, or for light that
    /// is still to be shot: a squared error which counts besides the variance.
    double unseen = 0;
    /// False where no light can reach anything that reflects, as the scene itself tells: then
    /// finding none is no lack of knowledge.
    bool may_find_light = true;
    /// Independent solutions whose spread the standard errors are; 0: the steps.
    double error_batches = 0;
    /// Effective degrees of freedom of the error (error_spread.h), where they are known better than
    /// from standard_error, which does not tell what patches err together.
    std::optional<double> effective_freedom;
    EnergyBalance energy;
    /// Patches from which `stored-transport` traces no more rays at random, as none of those that
    /// were traced has found a path to them from an emitter.
    std::size_t unlit = 0;
    std::size_t links = 0; ///< that `hierarchical` gathers over
    std::uint32_t steps = 0;
    std::uint64_t rays_energy = 0;
    std::uint64_t rays_density = 0;
    std::uint64_t rays_density_spared = 0; ///< below triangles that were not divided
    std::uint64_t bytes_density = 0;       ///< of the density store; 0 where a method keeps none
    std::uint64_t bytes_transport = 0;     ///< of the rays that `stored-transport` keeps
    double seconds_density = 0;            ///< spent before the first step
};

/// Errors relative to the reflected radiosity (RMS over area and channels, see docs): either over
/// all patches or split by a mask.
struct RelativeError {
    double all = 0;
    double detail = 0; ///< patches under the mask; NaN if there are none
    double rest = 0;   ///< the others; NaN if there are none
};

/// sqrt(sum_i A_i |B_i - B*_i|^2 / sum_i A_i |B*_i - E_i|^2).
[[nodiscard]] RelativeError true_error(const Mesh& mesh, std::span<const Vec3> radiosity,
                                       std::span<const Vec3> reference,
                                       const std::vector<bool>& detail = {});

/// The same as the solution knows it itself: from its variance, more where that is known badly
/// (ErrorSpread::reported), and what may not have been seen. NaN where it is not known: before two
/// steps, and where no light was found that is more than its own error.
[[nodiscard]] double estimated_error(const Mesh& mesh, const Solution& solution);

/// Standardised differences z = (B - B*) / sigma over patches with at least `min_hits` and all
/// channels with a positive sigma, where sigma^2 adds both standard errors.
struct ZScores {
    double mean = 0;
    double rms = 0;
    double largest = 0; ///< in magnitude
    std::size_t count = 0;
};
[[nodiscard]] ZScores z_scores(const Mesh& mesh, const Solution& solution,
                               std::span<const Vec3> reference,
                               std::span<const Vec3> reference_error, std::uint64_t min_hits = 30);

} // namespace hemilux
