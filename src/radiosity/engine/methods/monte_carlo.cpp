// Monte Carlo radiosity (paper section 3.2; Shirley 1991, "Radiosity via ray tracing", Graphics
// Gems II).
//
// The patch with the largest unshot energy A_i B_i shoots first, all of it at once, by rays from
// random points in cosine-distributed directions. Each ray carries about the same power, the same
// throughout the run, so a patch shoots rays in proportion to what it has gathered. No form factor
// is computed: a patch receives what the rays that hit it bring. Fractions of a ray are settled by
// chance: a patch with a third of a ray shoots a whole one in a third of all cases. This keeps the
// estimate unbiased and ends the step by itself.
//
// Each step is such a solution from emission on; the result is their mean (stepwise.h). With
// --one-shot, a step is one shot instead, so that a picture can be shown each time a patch has shot
// what it held, as in the paper. The run then ends with this one solution, that of the first step:
// its error is unknown.
//
// The parameter is --rays, the mean number of rays per patch and solution. The method is good as a
// yardstick: it uses nothing but rays. It is bad where small patches matter, whose error is that of
// counting few hits. It is also bad with many threads: a shot depends on the one before, so only
// the rays of one patch are traced at once. It traces one ray after another and needs hardly any
// memory.

#include "geometry/frame.h"
#include "parallel/workers.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/sampling/largest_first.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/shooting/stepwise.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/paper/pages/pages.h"
#include "radiosity/paper/rays/patch_start.h"
#include "radiosity/paper/solution/solve_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// The number of rays with a random stream of their own, which one thread traces.
constexpr std::size_t rays_per_stream = 512;
/// The number of rays whose receivers are kept until they are summed; whole streams. An emitter may
/// shoot millions.
constexpr std::size_t rays_per_batch = 2048 * rays_per_stream;
/// Fewer rays than this are traced before other threads could be started.
constexpr std::size_t rays_for_one_thread = 2048;

/// One solution of all bounces, shot by shot. `result` comes with the emission as radiosity and
/// gets what the shots have brought.
class Shots {
  public:
    Shots(const SolverInput& input, const StepTask& task, StepResult& result)
        : input_(input), task_(task), result_(result), unshot_(result.radiosity.size()),
          received_(unshot_.size()), order_(unshot_.size()) {
        for (std::uint32_t i = 0; i < unshot_.size(); ++i) {
            unshot_[i] += result.radiosity[i] * input_.mesh.patches()[i].area;
            order_.set(i, mean_of_channels(unshot_[i].value()));
        }
    }

    [[nodiscard]] bool done() const { return !(order_.largest() > 0); }

    /// Shoots from the patch that holds most. Returns false when interrupted.
    bool shoot_next() {
        if (input_.monitor.interrupted)
            return false;
        const auto shooter = static_cast<std::uint32_t>(order_.index_of_largest());
        const Vec3 power = std::exchange(unshot_[shooter], {}).value();
        order_.set(shooter, 0);
        check_finite(input_.mesh, shooter, power, "the power to be shot", task_.number);
        check_bounces(input_.mesh, shots_ / unshot_.size(), task_.number);
        result_.shot += mean_of_channels(power);
        const Shot shot = aim(shooter, power);
        for (std::size_t first = 0; first < shot.rays; first += rays_per_batch) {
            shoot(shot, first);
            if (input_.monitor.interrupted)
                return false;
            receive(shot);
        }
        result_.sent += double(shot.rays) * shot.each;
        ++shots_;
        return true;
    }

    /// Sets the radiosity from all power that each patch has received so far.
    void reflect() {
        result_.absorbed = absorbed_on_backs_;
        for (std::uint32_t i = 0; i < received_.size(); ++i) {
            const Material& material = input_.mesh.material(i);
            const Vec3 power = received_[i].value();
            const double area = input_.mesh.patches()[i].area;
            result_.absorbed += (1.0 - material.reflectance) * power;
            if (area > 0)
                result_.radiosity[i] = material.emission + material.reflectance * power / area;
        }
    }

  private:
    struct Shot {
        std::uint32_t shooter;
        std::size_t rays;
        Vec3 each; ///< power of a ray
        std::uint64_t stream;
    };

    [[nodiscard]] Shot aim(std::uint32_t shooter, const Vec3& power) const {
        const std::uint64_t stream = hash_words({input_.options.seed, task_.stream, shots_});
        const double expected = task_.rays(shooter, power);
        const double n = std::floor(expected + Rng(stream).uniform());
        // Below one ray, the ray that is shot carries the power of those that are not.
        return {shooter, static_cast<std::size_t>(n), power / (expected >= 1 ? n : expected),
                stream};
    }

    /// Traces some of the shot's rays, from `first` on.
    void shoot(const Shot& shot, std::size_t first) {
        const std::size_t rays = std::min(shot.rays - first, rays_per_batch);
        receivers_.resize(rays);
        const Workers workers = rays < rays_for_one_thread ? Workers(1) : task_.workers;
        workers.for_chunks(rays, rays_per_stream, [&](std::size_t begin, std::size_t end) {
            if (input_.monitor.interrupted)
                return;
            Rng rng(hash_words({shot.stream, (first + begin) / rays_per_stream}));
            const auto start = PatchStart::in_any_axes(input_.mesh, shot.shooter);
            std::vector<Ray> drawn;
            std::vector<std::uint32_t> hits;
            for (std::size_t k = begin; k < end; ++k)
                drawn.push_back(start.cosine_ray(rng));
            find_receivers(drawn, input_.mesh, input_.tracer, hits);
            std::ranges::copy(hits, receivers_.begin() + static_cast<std::ptrdiff_t>(begin));
        });
    }

    void receive(const Shot& shot) {
        for (const std::uint32_t i : receivers_)
            if (i < unshot_.size()) {
                received_[i] += shot.each;
                unshot_[i] += input_.mesh.material(i).reflectance * shot.each;
                order_.set(i, mean_of_channels(unshot_[i].value()));
                ++result_.hits[i];
            } else {
                (i == escaped ? result_.escaped : absorbed_on_backs_) += shot.each;
            }
        result_.rays += receivers_.size();
        input_.monitor.rays += receivers_.size();
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(result_.rays) /
                              (input_.options.rays * static_cast<double>(unshot_.size())));
    }

    const SolverInput& input_;
    const StepTask& task_;
    StepResult& result_;
    std::uint64_t shots_ = 0;
    std::vector<CompensatedSum<Vec3>> unshot_, received_; ///< power by patch
    CompensatedSum<Vec3> absorbed_on_backs_;
    LargestFirst order_;
    std::vector<std::uint32_t> receivers_; ///< receivers of some of a shot's rays, ray by ray
};

bool shoot_all(const SolverInput& input, const StepTask& task, StepResult& result) {
    Shots shots(input, task, result);
    while (!shots.done())
        if (!shots.shoot_next())
            return false;
    shots.reflect();
    return true;
}

class MonteCarloSolver final : public StepwiseSolver {
  public:
    explicit MonteCarloSolver(const SolverInput& input) : StepwiseSolver(input, true, false) {}

  private:
    [[nodiscard]] bool steps_are_alike() const override { return true; }
    bool solve_once(const StepTask& task, StepResult& result) override {
        return shoot_all(input_, task, result);
    }
};

/// A solver that takes the first step of the same, and whose steps are its shots.
class OneShotSolver final : public EngineSolver {
  public:
    explicit OneShotSolver(const SolverInput& input)
        : input_(input), mean_(input, true), start_(mean_.solution),
          result_(input.mesh), task_{0, 1, 0, Workers(input.options.threads)} {}

    bool step() override {
        if (!shots_ && !begin())
            return false;
        input_.monitor.phase = "shooting";
        if (!shots_->done()) {
            if (!shots_->shoot_next())
                return false;
            shots_->reflect();
        }
        publish();
        return true;
    }
    [[nodiscard]] const Solution& solution() const override { return mean_.solution; }
    [[nodiscard]] bool finished() const override { return shots_ && shots_->done(); }

  private:
    /// Shoots the pilot as StepwiseSolver does.
    bool begin() {
        const bool found = mean_.find_ray_power([&](double ray_power, StepResult& pilot) {
            return shoot_all(input_, {~std::uint64_t{0}, 1, ray_power, task_.workers}, pilot);
        });
        if (!found)
            return false;
        start_.rays_energy = mean_.solution.rays_energy;
        task_.ray_power = mean_.ray_power;
        shots_.emplace(input_, task_, result_);
        return true;
    }

    /// Publishes the light of all shots so far as the only step of a mean; each shot counts as a
    /// step.
    void publish() {
        const std::uint32_t steps = mean_.solution.steps;
        mean_.solution = start_;
        mean_.sums = {};
        mean_.sums.squares.assign(start_.radiosity.size(), Vec3(0.0));
        mean_.add(result_);
        mean_.solution.steps = steps + 1;
    }

    SolverInput input_;
    MeanOfSteps mean_;
    Solution start_; ///< light before the first shot
    StepResult result_;
    StepTask task_;
    std::optional<Shots> shots_; ///< empty before the pilot
};

std::unique_ptr<EngineSolver> make_monte_carlo(const SolverInput& input) {
    if (is_one_shot(input.options))
        return std::make_unique<OneShotSolver>(input);
    return std::make_unique<MonteCarloSolver>(input);
}

std::vector<MethodOption> options() { return {one_shot_option()}; }

} // namespace

extern const Method monte_carlo_method{
    .name = "monte-carlo",
    .summary = "the brightest patch shoots all it holds by random rays (Shirley 1991; paper 3.2)",
    .unbiased = true,
    .default_stop = {.steps = 16, .seconds = {}, .error = {}},
    .make = make_monte_carlo,
    .work = {.passes = true},
    .saves = true,
    .plain = plain::monte_carlo,
    .aims = has_aimer,
    .options = options,
    .adapt = [](MethodWork& work,
                const SolveOptions& options) { work.ends_by_itself = is_one_shot(options); },
};

} // namespace hemilux
