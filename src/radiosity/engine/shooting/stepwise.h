#pragma once
// Methods whose steps are independent solutions of all bounces (mean_of_steps.h). As they are
// independent, several are solved at the same time, each by a thread, or by a rank.

#include "parallel/workers.h"
#include "radiosity/engine/shooting/aimer.h"
#include "radiosity/engine/shooting/separate_rays.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/solving/mean_of_steps.h"

#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

/// One step to be solved.
struct StepTask {
    std::uint64_t stream; ///< stream of its random numbers
    std::uint64_t number; ///< number from 1; the pilot belongs to the first
    double ray_power;     ///< mean power that a ray is to carry, mean of channels; or infinite
    Workers workers;      ///< threads for this one
    std::span<const double> aimed = {};     ///< MeanOfSteps::aimed
    const SeparateRays* separate = nullptr; ///< rays besides those of the strategy

    /// Returns how many rays the patch is to shoot, on average.
    [[nodiscard]] double rays(std::uint32_t patch, const Vec3& power) const {
        return mean_of_channels(power) / ray_power * (aimed.empty() ? 1 : aimed[patch]);
    }
};

/// Throws SolveError after so many bounces that the series seems not to end.
void check_bounces(const Mesh& mesh, std::uint64_t bounces, std::uint64_t step);

class StepwiseSolver : public EngineSolver {
  public:
    bool step() final;
    [[nodiscard]] const Solution& solution() const final { return mean_.solution; }
    /// Returns true after a step if nothing reflects: radiosity is then emission, and no step
    /// improves it.
    [[nodiscard]] bool finished() const final {
        return !input_.needs.bounces && mean_.solution.steps > 0;
    }
    [[nodiscard]] std::uint32_t steps_ready() const final;
    void save(StateWriter& state) const final;
    void load(StateReader& state) final;

  protected:
    /// Without equal rays there is no power per ray: each patch shoots the same number of rays.
    /// With `separately`, solve_once shoots the separate rays of a task.
    StepwiseSolver(const SolverInput& input, bool equal_rays, bool separately);

    /// Finds one solution of all bounces. `result` comes with the emission as radiosity and nothing
    /// else. Returns false when interrupted. If steps are alike, it is called for several at the
    /// same time.
    virtual bool solve_once(const StepTask& task, StepResult& result) = 0;
    /// Returns whether no step depends on those before.
    [[nodiscard]] virtual bool steps_are_alike() const { return false; }

    /// These save and load what else the next steps depend on, as Solver does.
    virtual void save_more(StateWriter&) const {}
    virtual void load_more(StateReader&) {}

    /// Returns an estimate of the radiosity by patch, before a step: from the steps so far, or from
    /// the pilot.
    [[nodiscard]] std::span<const Vec3> estimate() const {
        return mean_.solution.steps > 0 || pilot_.empty() ? mean_.solution.radiosity : pilot_;
    }

    /// The stream of the pilot; steps count from 0.
    static constexpr std::uint64_t pilot_stream = ~std::uint64_t{0};

    SolverInput input_;
    MeanOfSteps mean_;

  private:
    /// A step that is solved, or that was begun.
    struct Ahead {
        StepResult result;
        bool done = false, failed = false;
        std::exception_ptr failure; ///< fault, where this rank has worked at it
    };
    void work_ahead();
    void work_at(std::size_t first, std::size_t every);
    [[nodiscard]] StepTask task_of(std::size_t ahead, const Workers& workers) const;
    void solve(Ahead& ahead, const StepTask& task);
    void gather_ahead();
    [[nodiscard]] unsigned side_by_side() const;
    [[nodiscard]] double steps_to_come() const;
    bool find_ray_power();
    bool shoot_pilot(const StepTask& task, StepResult& pilot);
    void check_ray_power() const;

    Workers workers_;
    std::deque<Ahead> ahead_;      ///< the next steps
    double seconds_per_step_ = 0;  ///< time of one thread, when several are worked out; 0: unknown
    std::vector<Vec3> pilot_;      ///< its radiosity; empty where there was none
    std::unique_ptr<Aimer> aimer_; ///< nullptr: all patches count alike
};

} // namespace hemilux
