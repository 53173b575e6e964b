#pragma once
// Holds what every method finds: the radiosity of each patch and its error.

#include "geometry/vector.h"
#include "radiosity/paper/solution/method_figures.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// The balance of the light of a solution, per channel [W]: emitted = absorbed + escaped + unshot.
struct EnergyBalance {
    Vec3 emitted{0.0};
    Vec3 absorbed{0.0}; ///< power that patches and backs take
    Vec3 escaped{0.0};
    /// Power that leaves patches and was not carried by rays: it is still to be shot, or differs by
    /// chance. It may be negative; chance adds 0 on average.
    Vec3 unshot{0.0};

    /// Returns the power that is missing or too much, relative to the emitted power, in the worst
    /// channel [-]; 0 if nothing is emitted.
    [[nodiscard]] double imbalance() const;
};

/// The change of the radiosity of a patch along the axes x and y of Frame::from_normal() of its
/// normal [W/m2 per unit of the local frame].
struct Slope {
    Vec3 x{0.0}, y{0.0};
};

struct Solution {
    std::vector<Vec3> radiosity; ///< B per patch [W/m2 leaving], own emission included
    /// The linear change of the light of each patch, whose mean is B. It is empty if the light is B
    /// everywhere on a patch.
    std::vector<Slope> slope = {};
    std::vector<Vec3> standard_error; ///< that of B [W/m2]; NaN before two steps
    std::vector<std::uint64_t> hits;  ///< energy rays that hit each patch
    /// The weight of the squared error and of the light of each patch in the error of the whole
    /// (target.h). It is empty where all are 1.
    std::vector<double> weight = {};
    [[nodiscard]] double weight_of(std::size_t patch) const {
        return weight.empty() ? 1 : weight[patch];
    }
    /// The sum over patches and channels of weight, area and variance of B, where that is known
    /// better than from standard_error. The latter is on the safe side where few rays arrive.
    std::optional<double> variance;
    /// The part of that sum due to errors that all light of a part of the scene shares.
    double variance_of_level = 0;
    /// The degrees of freedom of the estimate of that part: infinite where it was found by counting
    /// and not from the spread of a few samples.
    double level_freedom = std::numeric_limits<double>::infinity();
    /// The same sum for what no ray may have seen so far, by the rule of three, or for light that
    /// is still to be shot. It is a squared error which counts besides the variance.
    double missed = 0;
    /// False where no light can reach anything that reflects, as the scene itself shows: then
    /// finding none is no lack of knowledge.
    bool may_find_light = true;
    /// The number of independent solutions that the standard errors come from; 0 if they are the
    /// steps.
    double error_batches = 0;
    /// The effective degrees of freedom of the error (error_spread.h), where they are known better
    /// than from standard_error, which does not say what patches err together. Where level_freedom
    /// is finite, they are those of the error besides that of the level.
    std::optional<double> effective_freedom;
    EnergyBalance energy;
    std::uint32_t steps = 0;
    std::uint64_t rays_energy = 0;
    std::uint64_t rays_density = 0;
    std::uint64_t rays_density_spared = 0; ///< rays below undivided triangles
    std::uint64_t bytes_density = 0;       ///< size of the density store; 0: there is none
    double seconds_density = 0;            ///< spent before the first step
    MethodFigures figures = {};            ///< what only its method finds
};

/// Errors relative to the reflected radiosity [-], as root mean squares over area and channels: of
/// all patches, and split by a mask.
struct RelativeError {
    double all = 0;
    double detail = 0; ///< patches under the mask; NaN if there are none
    double rest = 0;   ///< the others; NaN if there are none
};

/// Returns sqrt(sum_i A_i |B_i - B*_i|^2 / sum_i A_i |B*_i - E_i|^2).
[[nodiscard]] RelativeError true_error(const Mesh& mesh, std::span<const Vec3> radiosity,
                                       std::span<const Vec3> reference,
                                       const std::vector<bool>& detail = {});

/// Returns the same error as the solution estimates it. It comes from the variance, which is
/// enlarged where it is poorly known (ErrorSpread::reported), and from light that may not have been
/// seen. It is NaN where it is unknown: before two steps, and where no light was found that exceeds
/// its own error.
[[nodiscard]] double estimated_error(const Mesh& mesh, const Solution& solution);

/// Returns the error of the patches that have no weight, by their standard errors. It is NaN where
/// there is no such patch, or no light on them that is more than its own error.
[[nodiscard]] double estimated_error_elsewhere(const Mesh& mesh, const Solution& solution);

/// Standardised differences z = (B - B*) / sigma over patches with at least `min_hits` and all
/// channels with a positive sigma, where sigma^2 adds both standard errors.
struct ZScores {
    double mean = 0;
    double rms = 0;
    double largest = 0; ///< largest magnitude
    std::size_t count = 0;
};
[[nodiscard]] ZScores z_scores(const Mesh& mesh, const Solution& solution,
                               std::span<const Vec3> reference,
                               std::span<const Vec3> reference_error, std::uint64_t min_hits = 30);

} // namespace hemilux
