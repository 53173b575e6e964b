#pragma once
// Computes the mean of steps each of which is a complete solution of all bounces, independent of
// the others (docs/paper/decisions.md, D11). Paper section 5b, point 2: "the radiosity of each
// patch computed up until the previous step is combined with the radiosity computed in the current
// step".
//
// The spread of the steps is the standard error of their mean (D16, D19).

#include "geometry/compensated_sum.h"
#include "radiosity/paper/solving/solver.h"

#include <cstdint>
#include <vector>

namespace hemilux {

/// The findings of one step. Powers are in local units.
struct StepResult {
    StepResult() = default;
    /// Begins a step: nothing has been shot, and the radiosity is the emission.
    explicit StepResult(const Mesh& mesh);

    std::vector<Vec3> radiosity;                  ///< radiosity by patch [W/m2]
    std::vector<std::uint32_t> hits;              ///< rays that hit each patch
    CompensatedSum<Vec3> absorbed, escaped, sent; ///< power; `sent` is that of all rays
    double shot = 0; ///< all power that was to be shot, mean of channels
    std::uint64_t rays = 0;
};

/// The sums over the steps so far, besides their mean. Powers are in local units.
struct StepSums {
    std::vector<Vec3> squares; ///< sum of squared deviations of the radiosity, by patch
    /// The brightness of all light of a step beside the mean of the steps [-]: its mean, and the
    /// sum of its squared deviations.
    double level = 0, level_squares = 0;
    CompensatedSum<Vec3> absorbed, escaped, sent; ///< power
};

class MeanOfSteps {
  public:
    /// Begins without steps. Without `equal_rays` no power is common to all rays: each patch shoots
    /// as many as any other. Throws SolveError as solution_before_steps() does.
    MeanOfSteps(const SolverInput& input, bool equal_rays);

    /// Finds the power per ray by a pilot of few rays, so that a step shoots as many rays as were
    /// asked for. All bounces together carry several times the emitted power, and how many depends
    /// on the scene. The power is then the same in all steps, which keeps them independent and
    /// equally weighted. The solution counts the rays of the pilot, but has none of its light.
    /// pilot(ray_power, result) solves a step whose rays carry so much on average; it returns false
    /// when interrupted, and so does this.
    template <class Pilot>
    bool find_ray_power(const Pilot& pilot) {
        StepResult result(input_.mesh);
        if (needs_pilot() && !pilot(ray_power_of_pilot(), result))
            return false;
        set_ray_power(result);
        return true;
    }

    /// Combines a step with those before. Throws SolveError if its radiosity is not finite.
    void add(const StepResult& step);
    /// Finds the errors of the solution from `sums`. Requires two steps.
    void estimate_errors();
    /// Returns the power that all patches emit, mean of channels [W/m2 times area in local units].
    [[nodiscard]] double emitted() const;
    [[nodiscard]] bool equal_rays() const { return equal_rays_; }

    Solution solution;
    StepSums sums;
    /// The power that each ray is to carry on average, mean of channels [W/m2 times area in local
    /// units]. It is 0 before find_ray_power(), and infinite where rays are not equal.
    double ray_power = 0;
    /// The ratio, by patch, of the rays to those that its power would give it; each carries as much
    /// less. It is empty where all are 1.
    std::vector<double> aimed;

  private:
    [[nodiscard]] bool needs_pilot() const { return equal_rays_ && emitted() > 0; }
    [[nodiscard]] double ray_power_of_pilot() const;
    void set_ray_power(const StepResult& of_pilot);
    void note_level(const std::vector<Vec3>& radiosity);
    [[nodiscard]] double weighted_area(std::uint32_t patch) const;
    [[nodiscard]] Vec3 power_leaving() const;
    [[nodiscard]] Vec3 mean_ray() const;
    [[nodiscard]] Vec3 purest_ray() const;
    [[nodiscard]] bool is_of_few_steps(std::uint32_t patch) const;
    [[nodiscard]] Vec3 one_ray(std::uint32_t patch) const;
    [[nodiscard]] double missed() const;

    SolverInput input_;
    bool equal_rays_;
};

} // namespace hemilux
