#include "radiosity/engine/shooting/stepwise.h"

#include "radiosity/engine/saving/solution_state.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/solving/shared_stop.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// The longest time that a state may name: ten thousand years [s].
constexpr double longest_seconds = 3e11;

} // namespace

StepwiseSolver::StepwiseSolver(const SolverInput& input, bool equal_rays, bool separately)
    : input_(input), mean_(input, equal_rays), workers_(input.options.threads) {
    if (!input.target.empty() && has_aimer())
        aimer_ = additions().make_aimer(input_, separately);
}

bool StepwiseSolver::step() {
    if (mean_.ray_power == 0 && !find_ray_power())
        return false;
    if (ahead_.empty())
        work_ahead();
    Ahead next = std::move(ahead_.front());
    ahead_.pop_front();
    if (next.failed && !next.failure) // on another rank: here it fails for the same reason
        solve(next, task_of(0, workers_));
    if (next.failure || !next.done)
        ahead_.clear();
    if (next.failure)
        std::rethrow_exception(next.failure);
    if (!next.done)
        return false;
    mean_.add(next.result);
    return true;
}

/// Distributes steps that are alike over the ranks in turn; any other step is solved by each rank.
void StepwiseSolver::work_ahead() {
    input_.monitor.phase = "step";
    ahead_.resize(side_by_side());
    const Ranks& ranks = ranks_of(input_.monitor.interrupted);
    if (!steps_are_alike() || !ranks.are_several())
        return work_at(0, 1);
    {
        const OnThisRank on_this_rank(input_.monitor.interrupted);
        work_at(ranks.index(), ranks.count());
    }
    agree(input_.monitor.interrupted);
    gather_ahead();
}

/// Each thread takes one step after another; threads that find none left help with the last.
void StepwiseSolver::work_at(std::size_t first, std::size_t every) {
    const std::size_t count = first < ahead_.size() ? (ahead_.size() - first - 1) / every + 1 : 0;
    if (count == 0)
        return;
    const auto start = std::chrono::steady_clock::now();
    const auto at_once = static_cast<unsigned>(std::min<std::size_t>(count, workers_.threads()));
    const Workers own(workers_.threads() / at_once);
    workers_.for_chunks(count, 1, [&](std::size_t k, std::size_t) {
        const std::size_t ahead = first + k * every;
        solve(ahead_[ahead], task_of(ahead, k + 1 == count ? workers_ : own));
    });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    seconds_per_step_ = took.count() * at_once / static_cast<double>(count);
}

/// Returns the task of the step that comes `ahead` steps after the next one.
StepTask StepwiseSolver::task_of(std::size_t ahead, const Workers& workers) const {
    const std::uint64_t number = mean_.solution.steps + ahead;
    return {number,  number + 1,  mean_.ray_power,
            workers, mean_.aimed, aimer_ ? aimer_->separate_rays() : nullptr};
}

void StepwiseSolver::solve(Ahead& ahead, const StepTask& task) {
    try {
        ahead.result = StepResult(input_.mesh);
        ahead.done = solve_once(task, ahead.result);
    } catch (...) {
        ahead.failure = std::current_exception();
        ahead.failed = true;
    }
}

/// Lets all ranks know what each has found.
void StepwiseSolver::gather_ahead() {
    struct Numbers {
        bool done, failed;
        CompensatedSum<Vec3> absorbed, escaped, sent;
        double shot;
        std::uint64_t rays;
    };
    const Ranks& ranks = ranks_of(input_.monitor.interrupted);
    seconds_per_step_ = ranks.of_first(seconds_per_step_);
    for (unsigned k = 0; k < ahead_.size(); ++k) {
        const unsigned rank = k % ranks.count();
        auto& [step, done, failed, failure] = ahead_[k];
        if (rank == ranks.index())
            ranks.add_work(step.rays, 0);
        const Numbers of_step = ranks.of_each(Numbers{done, failed, step.absorbed, step.escaped,
                                                      step.sent, step.shot, step.rays})[rank];
        done = of_step.done;
        failed = of_step.failed;
        step.absorbed = of_step.absorbed;
        step.escaped = of_step.escaped;
        step.sent = of_step.sent;
        step.shot = of_step.shot;
        step.rays = of_step.rays;
        if (!done)
            continue;
        step.radiosity.resize(input_.mesh.patches().size());
        step.hits.resize(step.radiosity.size());
        ranks.give_to_all(rank, std::span(step.radiosity));
        ranks.give_to_all(rank, std::span(step.hits));
    }
}

/// Returns as many steps as the threads solve in half a second, at least one for each thread, so
/// that none waits long for another. It returns no more than are still wanted. In large scenes a
/// single step keeps all threads of a rank busy, and several would take much memory.
unsigned StepwiseSolver::side_by_side() const {
    constexpr std::size_t max_patches = 100'000;
    constexpr double seconds_ahead = .5, max_each = 16;
    if (!steps_are_alike())
        return 1;
    const Ranks& ranks = ranks_of(input_.monitor.interrupted);
    const unsigned threads = ranks.of_first(workers_.threads());
    const bool several = threads * ranks.count() > 1;
    double of_rank = 1;
    if (several && input_.mesh.patches().size() <= max_patches) {
        const double each = seconds_per_step_ > 0 ? seconds_ahead / seconds_per_step_ : 1;
        of_rank = threads * std::floor(std::clamp(each, 1.0, max_each));
    }
    return static_cast<unsigned>(std::min(steps_to_come(), of_rank * ranks.count()));
}

std::uint32_t StepwiseSolver::steps_ready() const {
    std::uint32_t ready = 0;
    while (ready < ahead_.size() && ahead_[ready].done)
        ++ready;
    return ready;
}

/// Returns the number of steps to come as far as it is known, at least 1. Two are needed to
/// estimate an error, which then falls with the root of their number.
double StepwiseSolver::steps_to_come() const {
    const StopRule& stop = input_.options.stop;
    const std::uint32_t expected = stop.expected_steps();
    const double done = mean_.solution.steps;
    double last = expected > 0 ? expected : done + 1;
    if (stop.error) {
        const double off = estimated_error(input_.mesh, mean_.solution) / *stop.error;
        const double by_error = done < 2 ? 2 : done * off * off;
        last = expected > 0 ? std::min(last, by_error) : by_error;
    }
    return last > done + 1 ? last - done : 1;
}

bool StepwiseSolver::find_ray_power() {
    return mean_.find_ray_power([&](double ray_power, StepResult& pilot) {
        if (!input_.needs.bounces) { // all that a step shoots is known
            for (std::uint32_t i = 0; i < input_.mesh.patches().size(); ++i)
                pilot.shot += mean_of_channels(pilot.radiosity[i] * input_.mesh.patches()[i].area);
            return true;
        }
        if (!shoot_pilot({pilot_stream, 1, ray_power, workers_}, pilot))
            return false;
        pilot_ = pilot.radiosity;
        return true;
    });
}

/// If rays are aimed, the pilot finds out what is important to the target.
bool StepwiseSolver::shoot_pilot(const StepTask& task, StepResult& pilot) {
    return aimer_ ? aimer_->shoot_pilot(task, pilot, mean_) : solve_once(task, pilot);
}

/// Rays die out by chance, which in a room of reflectance .99999 takes about 2e6 bounces.
void check_bounces(const Mesh& mesh, std::uint64_t bounces, std::uint64_t step) {
    constexpr std::uint64_t most = 10'000'000;
    if (bounces <= most)
        return;
    const auto unabsorbed = [&](std::uint32_t a, std::uint32_t b) {
        return mean_of_channels(mesh.material(a).reflectance) <
               mean_of_channels(mesh.material(b).reflectance);
    };
    std::uint32_t brightest = 0;
    for (std::uint32_t i = 1; i < mesh.patches().size(); ++i)
        if (unabsorbed(brightest, i))
            brightest = i;
    throw SolveError("step " + std::to_string(step) +
                         ": light is still on its way after ten million bounces, as between " +
                         name_of_patch(mesh, brightest) +
                         " and others; --method stored-transport needs no bounces",
                     face_of(mesh, brightest));
}

/// Emission, densities and the order of patches follow from the scene and are found again.
void StepwiseSolver::save(StateWriter& state) const {
    const Solution& solution = mean_.solution;
    const StepSums& sums = mean_.sums;
    state.add(std::uint64_t{solution.steps});
    state.add(solution.rays_energy);
    state.add(solution.seconds_density);
    for (const Vec3& power : {solution.energy.absorbed, solution.energy.escaped,
                              solution.energy.unshot, sums.absorbed.sum, sums.absorbed.lost,
                              sums.escaped.sum, sums.escaped.lost, sums.sent.sum, sums.sent.lost})
        state.add(power);
    state.add(mean_.ray_power);
    state.add(sums.level);
    state.add(sums.level_squares);
    state.add(std::span<const Vec3>(solution.radiosity));
    state.add(std::span<const Vec3>(sums.squares));
    state.add(std::span<const std::uint64_t>(solution.hits));
    if (aimer_)
        aimer_->save(state, mean_);
    save_more(state);
}

/// Throws StateError if the power of a ray does not fit the scene. It is 0 before the pilot and
/// infinite where rays are not equal. A step shoots about the emitted power, or as many times as
/// much as there are bounces (check_bounces).
void StepwiseSolver::check_ray_power() const {
    constexpr double min_times = 1e-3, max_times = 1e9;
    const double ray_power = mean_.ray_power, emitted = mean_.emitted();
    const double once =
        emitted / (input_.options.rays * static_cast<double>(input_.mesh.patches().size()));
    const bool equal = mean_.equal_rays() && emitted > 0;
    const bool fits = ray_power == 0 ? mean_.solution.steps == 0
                      : equal ? ray_power >= min_times * once && ray_power <= max_times * once
                              : ray_power > bounds::largest;
    if (!fits)
        throw StateError("the power of a ray is none of this scene's");
}

void StepwiseSolver::load(StateReader& state) {
    Solution& solution = mean_.solution;
    StepSums& sums = mean_.sums;
    solution.steps =
        static_cast<std::uint32_t>(state.whole_up_to(std::numeric_limits<std::uint32_t>::max()));
    solution.rays_energy = state.whole();
    solution.seconds_density += state.number({0, longest_seconds}); // both were spent
    for (Vec3* power : {&solution.energy.absorbed, &solution.energy.escaped,
                        &solution.energy.unshot, &sums.absorbed.sum, &sums.absorbed.lost,
                        &sums.escaped.sum, &sums.escaped.lost, &sums.sent.sum, &sums.sent.lost})
        state.get(*power, bounds::finite);
    state.get(mean_.ray_power);
    check_ray_power();
    sums.level = state.number({-largest_radiosity, largest_radiosity});
    sums.level_squares = state.number(bounds::non_negative);
    load_light(solution.radiosity, largest_radiosity, state);
    state.get(std::span(sums.squares), bounds::non_negative);
    state.get(std::span(solution.hits));
    std::uint64_t hits_left = solution.rays_energy;
    for (const std::uint64_t hits : solution.hits) {
        if (hits > hits_left)
            throw StateError("more rays arrived than were traced");
        hits_left -= hits;
    }
    if (aimer_)
        aimer_->load(state, mean_);
    if (solution.steps > 1)
        mean_.estimate_errors();
    load_more(state);
}

} // namespace hemilux
