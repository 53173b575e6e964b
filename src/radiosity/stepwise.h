#pragma once
// Methods each of whose steps is a complete solution of all bounces, independent of the other
// steps (docs/decisions.md, D11): the result is the mean of the steps, its standard error their
// spread.

#include "geometry/compensated_sum.h"
#include "radiosity/solver.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

/// What one step found. Powers are in local units.
struct StepResult {
    std::vector<Vec3> radiosity;
    std::vector<std::uint32_t> hits;              ///< rays that struck each patch
    CompensatedSum<Vec3> absorbed, escaped, sent; ///< power, `sent`: of all rays
    double shot = 0; ///< all power that was to be shot, mean of channels
    std::uint64_t rays = 0;
};

class StepwiseSolver : public Solver {
  public:
    bool step() final;
    [[nodiscard]] const Solution& solution() const final { return solution_; }
    /// Where nothing reflects, radiosity is emission: no step improves it.
    [[nodiscard]] bool finished() const final {
        return !input_.needs.bounces && solution_.steps > 0;
    }
    void save(StateWriter& state) const final;
    void load(StateReader& state) final;

  protected:
    /// Without equal rays there is no power per ray: each patch shoots as many rays as any other.
    StepwiseSolver(const SolverInput& input, bool equal_rays);

    /// One solution of all bounces. `result` comes with emission as radiosity and nothing else.
    /// False when interrupted.
    virtual bool solve_once(std::uint64_t stream, StepResult& result) = 0;

    /// What the next steps depend on besides, see Solver.
    virtual void save_more(StateWriter&) const {}
    virtual void load_more(StateReader&) {}

    /// Of the radiosity, before a step: by the steps so far, or by the pilot.
    [[nodiscard]] std::span<const Vec3> estimate() const {
        return solution_.steps > 0 || pilot_.empty() ? solution_.radiosity : pilot_;
    }

    /// Power that each ray is to carry on average, mean of channels; infinite without equal rays.
    [[nodiscard]] double ray_power() const { return ray_power_; }
    /// From 1; the pilot belongs to the first.
    [[nodiscard]] std::uint64_t step_under_way() const { return solution_.steps + 1; }
    /// Mean of channels, local units.
    [[nodiscard]] double emitted() const;

    /// Throws SolveError after so many that the series seems not to end.
    void check_bounces(std::uint64_t bounces) const;

    /// The stream of the pilot; steps count from 0.
    static constexpr std::uint64_t pilot_stream = ~std::uint64_t{0};

    SolverInput input_;
    Solution solution_;

  private:
    [[nodiscard]] Vec3 power_leaving() const;
    [[nodiscard]] StepResult fresh_result() const;
    bool find_ray_power();
    [[nodiscard]] Vec3 one_ray(std::uint32_t patch) const;
    void combine(const StepResult& result);
    void account(const StepResult& result);

    bool equal_rays_;
    double ray_power_ = 0;      ///< 0 until the pilot has found it
    std::vector<Vec3> pilot_;   ///< its radiosity; empty where there was none
    std::vector<Vec3> squares_; ///< sum of squared deviations of the steps (Welford 1962)
    CompensatedSum<Vec3> absorbed_, escaped_, sent_; ///< of all steps
};

} // namespace hemilux
