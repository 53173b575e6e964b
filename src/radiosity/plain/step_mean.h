#pragma once
// Paper section 5b, point 2: "the radiosity of each patch computed up until the previous step is
// combined with the radiosity computed in the current step".
//
// Each step is a complete solution of all bounces, independent of the others, so the result is
// their mean and their spread is its standard error (docs/decisions.md, D11, D16, D19).

#include "geometry/compensated_sum.h"
#include "radiosity/solving/solver.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux::plain {

/// What one step found so far. Powers are in local units.
struct Step {
    /// Nothing but emission, which is to be shot.
    explicit Step(const Mesh& of);

    /// A ray brings its power to the patch that it strikes, which is returned; none where it
    /// leaves the scene or falls on the back of a face.
    std::uint32_t receive(const std::optional<Hit>& hit, const Vec3& Phi_ray);
    /// B = E + rho Phi / A: what was received since the last call is absorbed, or to be shot.
    void reflect();
    /// Of all patches, mean of channels.
    [[nodiscard]] double power_unshot() const;

    const Mesh& mesh;
    std::vector<Vec3> radiosity;
    std::vector<Vec3> unshot;                   ///< Phi_patch
    std::vector<CompensatedSum<Vec3>> received; ///< power
    std::vector<std::uint64_t> hits;            ///< rays that struck each patch
    std::uint64_t rays = 0;
    double shot = 0; ///< all power that was to be shot, mean of channels
    CompensatedSum<Vec3> sent, absorbed, escaped; ///< by rays
};

class StepMean : public Solver {
  public:
    bool step() final;
    [[nodiscard]] const Solution& solution() const final { return solution_; }
    /// Where nothing reflects, radiosity is emission: no step improves it.
    [[nodiscard]] bool finished() const final {
        return !input_.needs.bounces && solution_.steps > 0;
    }

  protected:
    /// `equal_rays`: rays carry about the same power in all steps.
    StepMean(const SolverInput& input, bool equal_rays);

    /// One solution of all bounces. `Phi_mean`: what a ray is to carry. False when interrupted.
    virtual bool compute_radiosity(std::uint64_t step, double Phi_mean, Step& result) = 0;

    /// The number of the pilot among the steps, which count from 0.
    static constexpr std::uint64_t pilot = ~std::uint64_t{0};

    SolverInput input_;
    Solution solution_;

  private:
    bool find_Phi_mean();
    void combine(const Step& step);
    void note_level(const Step& step);
    void estimate_errors();
    [[nodiscard]] Vec3 power_leaving() const;
    [[nodiscard]] Vec3 mean_ray() const;
    [[nodiscard]] Vec3 one_ray(std::uint32_t patch) const;
    [[nodiscard]] double unseen() const;

    bool equal_rays_;
    double Phi_mean_ = 0;
    std::vector<Vec3> squares_;                      ///< sum of squared deviations of the steps
    double level_ = 0, level_squares_ = 0;           ///< of how bright a step is as a whole
    CompensatedSum<Vec3> sent_, absorbed_, escaped_; ///< of all steps
};

} // namespace hemilux::plain
