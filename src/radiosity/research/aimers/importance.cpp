// Aims the rays of steps at a target by importance (aimed_rays.h), and where the target is small
// also straight to it (rays_to_balls.h).

#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/aimer.h"
#include "radiosity/engine/target/target.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/solving/mean_of_steps.h"
#include "radiosity/research/targets/aimed_rays.h"
#include "radiosity/research/targets/rays_to_balls.h"

#include <utility>

namespace hemilux {
namespace {

class ByImportance final : public Aimer {
  public:
    ByImportance(const SolverInput& input, bool has_balls) : input_(input), has_balls_(has_balls) {}

    bool shoot_pilot(const StepTask& task, StepResult& pilot, MeanOfSteps& mean) override {
        Aim aim = aim_rays(input_, task, has_balls_, pilot);
        mean.aimed = std::move(aim.times);
        to_balls_.balls = std::move(aim.balls);
        return !mean.aimed.empty();
    }
    [[nodiscard]] const SeparateRays* separate_rays() const override {
        return to_balls_.balls.count() > 0 ? &to_balls_ : nullptr;
    }

    void save(StateWriter& state, const MeanOfSteps& mean) const override {
        const TargetBalls& balls = to_balls_.balls;
        state.add(hash_of_weights(input_.target));
        state.add(std::span<const double>(mean.aimed));
        state.add(std::uint64_t{balls.count() > 0});
        state.add(balls.times());
    }
    void load(StateReader& state, MeanOfSteps& mean) override;

  private:
    void load_balls(StateReader& state, bool is_aimed);

    SolverInput input_;
    bool has_balls_;
    RaysToBalls to_balls_;
};

/// Over all power, patches must get about as many rays as by power alone.
void ByImportance::load(StateReader& state, MeanOfSteps& mean) {
    constexpr Bounds times{1e-6, 1e6};
    constexpr double max_rays = 1e3; // for those that power alone would give
    if (state.whole() != hash_of_weights(input_.target))
        throw StateError("what the run was for is not what it is for this time");
    const bool is_aimed = mean.ray_power > 0 && mean.ray_power <= bounds::largest;
    mean.aimed.resize(is_aimed && input_.needs.bounces ? input_.target.size() : 0);
    state.get(std::span(mean.aimed), times);
    load_balls(state, is_aimed);
    const TargetBalls& balls = to_balls_.balls;
    double power = 0, rays = 0;
    for (std::uint32_t i = 0; i < mean.aimed.size(); ++i) {
        const double of_patch =
            input_.mesh.patches()[i].area * mean_of_channels(mean.solution.radiosity[i]);
        power += of_patch;
        rays += of_patch * mean.aimed[i];
        for (std::size_t k = 0; k < balls.count(); ++k)
            rays += of_patch * balls.times(i, k);
    }
    if (!(rays <= max_rays * power))
        throw StateError("its patches would trace far more rays than are asked for");
}

/// Loads the numbers of rays to the balls; none are saved if no ball gets rays.
void ByImportance::load_balls(StateReader& state, bool is_aimed) {
    constexpr Bounds times{0, 1e6};
    if (is_aimed && has_balls_)
        to_balls_.balls = TargetBalls(input_.mesh, values_of_arrival(input_));
    if (!state.flag())
        to_balls_.balls = {};
    state.get(to_balls_.balls.times(), times);
}

std::unique_ptr<Aimer> make_by_importance(const SolverInput& input, bool separately) {
    return std::make_unique<ByImportance>(input, separately);
}

} // namespace

extern const MakeAimer importance_aimer = make_by_importance;

} // namespace hemilux
