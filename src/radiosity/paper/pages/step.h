#pragma once
// The pages that trace bounces share this: the power that patches receive and shoot in a step, the
// rays that they are due, and the mean of the steps (mean_of_steps.h).

#include "radiosity/paper/pages/ray_numbers.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solving/mean_of_steps.h"

#include <cstdint>
#include <vector>

namespace hemilux::plain {

/// All patches with power to shoot own intervals of one line, as long as the rays that they are
/// due. A ray stands at each whole number. So each number of rays is rounded up or down, and is
/// right on average (docs/paper/decisions.md, D4, D10).
struct Due {
    std::uint32_t patch;
    std::uint64_t key; ///< key of its random numbers in this bounce
    double begin, end; ///< places on the line [rays]
    [[nodiscard]] double rays() const { return end - begin; }
};

/// A whole number of rays, and the number by which the power of all is divided for one.
struct Rays {
    std::uint64_t number;
    double divisor;
};
/// Returns N rays that own the line from `begin` to `end`. If N is below one, the ray that is shot
/// carries the power of those that are not.
[[nodiscard]] Rays rays_on_line(double N, double begin, double end);
[[nodiscard]] inline Rays rays_on_line(const Due& due) {
    return rays_on_line(due.rays(), due.begin, due.end);
}
/// Returns the rays of a part of the patch's interval, from one share of it to another [-].
[[nodiscard]] Rays rays_on_line(const Due& due, double from, double to);
/// Returns N rays as printed: rounded, so that power is lost where N is below one half.
[[nodiscard]] Rays rays_rounded(double N);

/// The light that one step has found so far. Powers are in local units.
struct Step : StepResult {
    /// A step begins with the emission, all of which is to be shot.
    explicit Step(const SolverInput& of);

    /// Returns what each patch with unshot power is due in a bounce, where rays carry `Phi_mean`
    /// and random numbers come from `stream`. All of this power counts as shot.
    [[nodiscard]] std::vector<Due> due(std::uint64_t stream, double Phi_mean);
    /// Shoots a ray, which brings its power to the patch that it hits. Returns this patch; none if
    /// the ray leaves the scene or hits the back of a face.
    std::uint32_t shoot(const Ray& ray, const Vec3& Phi_ray);
    /// Shoots a ray from a point of a patch.
    void shoot(const Patch& from, const Vec3& start, const Vec3& direction, const Vec3& Phi_ray);
    /// Applies B = E + rho Phi / A: what was received since the last call is absorbed, or to be
    /// shot.
    void reflect();
    /// Returns the unshot power of all patches, mean of channels.
    [[nodiscard]] double power_unshot() const;

    SolverInput input;
    std::vector<Vec3> unshot;                   ///< Phi_patch, by patch
    std::vector<CompensatedSum<Vec3>> received; ///< power, by patch
};

/// Shoots a patch's power by the cosine law, as the page of section 3.3 shows.
void shoot_plainly(const Due& due, const Rays& rays, Step& result);

class StepSolver : public Solver {
  public:
    bool step() final;
    [[nodiscard]] const Solution& solution() const final { return mean_.solution; }
    /// Returns true after a step if nothing reflects: radiosity is then emission, and no step
    /// improves it.
    [[nodiscard]] bool finished() const final {
        return !input_.needs.bounces && mean_.solution.steps > 0;
    }

  protected:
    /// With `equal_rays`, rays carry about the same power in all steps.
    StepSolver(const SolverInput& input, bool equal_rays)
        : input_(input), mean_(input, equal_rays) {}

    /// Finds one solution of all bounces, with rays that carry `Phi_mean` on average. Returns false
    /// when interrupted.
    virtual bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) = 0;

    /// Counts the surfaces along a direction of the patch's hemisphere, from a point of the patch,
    /// as one byte holds them. Directions on the horizon are lifted a little (D7).
    [[nodiscard]] std::uint8_t count_surfaces(std::uint32_t patch, const Vec3& from,
                                              const Vec3& direction);

    SolverInput input_;
    MeanOfSteps mean_;

  private:
    bool solve_once(std::uint64_t number, double Phi_mean, StepResult& result);
};

} // namespace hemilux::plain
