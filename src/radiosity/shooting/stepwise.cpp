#include "radiosity/shooting/stepwise.h"

#include "radiosity/rays/shot.h"
#include "radiosity/saving/solution_state.h"
#include "radiosity/saving/state.h"
#include "radiosity/scene/alike_neighbours.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solving/check_input.h"
#include "radiosity/solving/error_spread.h"
#include "radiosity/solving/solve_error.h"
#include "radiosity/solving/unseen_sights.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// Seconds that a state may tell of: ten thousand years.
constexpr double longest_seconds = 3e11;

} // namespace

StepwiseSolver::StepwiseSolver(const SolverInput& input, bool equal_rays)
    : input_(input), workers_(input.options.threads), equal_rays_(equal_rays) {
    check_input(input);
    const auto patches = input_.mesh.patches();
    const double unknown = input.needs.bounces ? std::numeric_limits<double>::quiet_NaN() : 0;
    solution_.standard_error.assign(patches.size(), Vec3(unknown));
    solution_.may_find_light = input.needs.bounces;
    solution_.hits.assign(patches.size(), 0);
    squares_.assign(patches.size(), Vec3(0.0));
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        solution_.radiosity.push_back(input_.mesh.material(i).emission);
    solution_.energy.emitted = input_.mesh.frame().area_to_world(1.0) * power_leaving();
    solution_.energy.unshot = solution_.energy.emitted;
}

bool StepwiseSolver::step() {
    if (ray_power_ == 0 && !find_ray_power())
        return false;
    if (ahead_.empty())
        work_ahead();
    const Ahead next = std::move(ahead_.front());
    ahead_.pop_front();
    if (next.failure || !next.done)
        ahead_.clear();
    if (next.failure)
        std::rethrow_exception(next.failure);
    if (!next.done)
        return false;
    check_finite(input_.mesh, next.result.radiosity, "the radiosity", solution_.steps + 1);
    combine(next.result);
    return true;
}

/// Each thread takes one step after the other; whoever is done with all helps with the last.
void StepwiseSolver::work_ahead() {
    input_.monitor.phase = "step";
    const auto start = std::chrono::steady_clock::now();
    const unsigned count = side_by_side(), places = std::min(count, workers_.threads());
    make_places(places);
    ahead_.resize(count);
    std::atomic<unsigned> place{0};
    const Workers own(workers_.threads() / places);
    const auto work = [&](unsigned at, std::size_t k, std::size_t) {
        const StepTask task{solution_.steps + k, solution_.steps + k + 1, ray_power_, at,
                            k + 1 == count ? workers_ : own};
        try {
            ahead_[k].result = fresh_result();
            ahead_[k].done = solve_once(task, ahead_[k].result);
        } catch (...) {
            ahead_[k].failure = std::current_exception();
        }
    };
    workers_.for_chunks_with(
        count, 1, [&] { return place++; }, work);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    seconds_per_step_ = took.count() * places / count;
}

/// If so many will be wanted, as many as threads work out within half a second, so that none waits
/// long for another, one at least for each. In large scenes a step keeps all threads busy, and
/// several would take much memory.
unsigned StepwiseSolver::side_by_side() const {
    constexpr std::size_t most_patches = 100'000;
    constexpr double seconds_ahead = .5, most_each = 16;
    if (!steps_are_alike() || workers_.threads() == 1 ||
        input_.mesh.patches().size() > most_patches)
        return 1;
    const double each =
        seconds_per_step_ > 0 ? std::clamp(seconds_ahead / seconds_per_step_, 1.0, most_each) : 1;
    return static_cast<unsigned>(std::min(steps_to_come(), std::floor(each) * workers_.threads()));
}

std::uint32_t StepwiseSolver::steps_ready() const {
    std::uint32_t ready = 0;
    while (ready < ahead_.size() && ahead_[ready].done)
        ++ready;
    return ready;
}

/// As far as it is known; at least 1. Two are needed to tell an error, which then falls as the root
/// of their number.
double StepwiseSolver::steps_to_come() const {
    const SolveOptions& options = input_.options;
    const double done = solution_.steps;
    double last = options.expected_steps > 0 ? options.expected_steps : done + 1;
    if (options.aim > 0) {
        const double off = estimated_error(input_.mesh, solution_) / options.aim;
        const double by_error = done < 2 ? 2 : done * off * off;
        last = options.expected_steps > 0 ? std::min(last, by_error) : by_error;
    }
    return last > done + 1 ? last - done : 1;
}

/// Of the solution, local units.
Vec3 StepwiseSolver::power_leaving() const {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < solution_.radiosity.size(); ++i)
        power += solution_.radiosity[i] * input_.mesh.patches()[i].area;
    return power.value();
}

StepResult StepwiseSolver::fresh_result() const {
    const auto patches = static_cast<std::uint32_t>(input_.mesh.patches().size());
    StepResult result;
    result.hits.assign(patches, 0);
    result.radiosity.reserve(patches);
    for (std::uint32_t i = 0; i < patches; ++i)
        result.radiosity.push_back(input_.mesh.material(i).emission);
    return result;
}

double StepwiseSolver::emitted() const {
    return mean_of_channels(solution_.energy.emitted / input_.mesh.frame().area_to_world(1.0));
}

/// All bounces together carry several times the emitted power; how many depends on the scene. A
/// pilot of few rays finds it, so that a step shoots as many rays as were asked for. The power per
/// ray is then the same in all steps, which keeps them independent and equally weighted.
bool StepwiseSolver::find_ray_power() {
    input_.monitor.phase = "pilot";
    const auto patches = static_cast<double>(input_.mesh.patches().size());
    const double rays = input_.options.rays * patches;
    const double pilot_rays = std::clamp(rays / 16, 1000.0, 400'000.0);
    if (!equal_rays_ || !(emitted() > 0)) {
        ray_power_ = std::numeric_limits<double>::infinity();
        return true;
    }
    StepResult pilot = fresh_result();
    if (!input_.needs.bounces) { // all that a step shoots is known
        for (std::uint32_t i = 0; i < input_.mesh.patches().size(); ++i)
            pilot.shot += mean_of_channels(pilot.radiosity[i] * input_.mesh.patches()[i].area);
        ray_power_ = pilot.shot / rays;
        return true;
    }
    ray_power_ = emitted() / (1 - mean_reflectance(input_.mesh)) / pilot_rays;
    make_places(1);
    if (!solve_once({pilot_stream, 1, ray_power_, 0, workers_}, pilot)) {
        ray_power_ = 0;
        return false;
    }
    solution_.rays_energy += pilot.rays;
    pilot_ = std::move(pilot.radiosity);
    ray_power_ = pilot.shot / rays;
    return true;
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

/// What a single ray of all steps so far has added to the patch's radiosity, on average; where none
/// has struck it, what one of mean power would add.
Vec3 StepwiseSolver::one_ray(std::uint32_t patch) const {
    if (equal_rays_ && solution_.hits[patch] > 0)
        return (solution_.radiosity[patch] - input_.mesh.material(patch).emission) /
               static_cast<double>(solution_.hits[patch]);
    const double area = input_.mesh.patches()[patch].area;
    if (!(area > 0))
        return Vec3(0.0);
    return input_.mesh.material(patch).reflectance * mean_ray() / area;
}

/// The power of a ray in the mean of the steps, local units; 0 where rays have none in common.
Vec3 StepwiseSolver::mean_ray() const {
    const double emitted_power = mean_of_channels(solution_.energy.emitted);
    if (!equal_rays_ || !(emitted_power > 0))
        return Vec3(0.0);
    return ray_power_ / (emitted_power * solution_.steps) * solution_.energy.emitted;
}

/// The most that a ray may bring of a channel: that of the emitter which shines in it most purely.
Vec3 StepwiseSolver::purest_ray() const {
    Vec3 share(0.0);
    for (const Facet& facet : input_.mesh.scene().facets) {
        const Vec3& emission = input_.mesh.scene().materials[facet.material].emission;
        if (emission != Vec3(0.0))
            share = glm::max(share, emission / mean_of_channels(emission));
    }
    return mean_of_channels(mean_ray()) * share;
}

/// Area times squared radiosity that rays would have brought that struck nothing so far, by the
/// rule of three: as three more of mean power, each anywhere.
double StepwiseSolver::unseen() const {
    const Vec3 power = rule_of_three * mean_ray();
    double area = 0, squares = 0;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        const Vec3 reflected = input_.mesh.material(i).reflectance * power;
        area += input_.mesh.patches()[i].area;
        squares += glm::dot(reflected, reflected);
    }
    return squares / area;
}

/// Mean and spread of the steps.
void StepwiseSolver::combine(const StepResult& result) {
    const std::vector<Vec3>& radiosity = result.radiosity;
    const double n = ++solution_.steps;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 before = n > 1 ? solution_.radiosity[i] : Vec3(0.0);
        solution_.radiosity[i] = before + (radiosity[i] - before) / n;
        solution_.hits[i] += result.hits[i];
        if (n > 1)
            squares_[i] += (radiosity[i] - before) * (radiosity[i] - solution_.radiosity[i]);
    }
    note_level(radiosity);
    if (n > 1)
        estimate_errors();
    solution_.rays_energy += result.rays;
    account(result);
}

/// How much of the reflected light of the mean a step has, where all patches err together.
void StepwiseSolver::note_level(const std::vector<Vec3>& radiosity) {
    double of_step = 0, of_mean = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 emission = input_.mesh.material(i).emission;
        const Vec3 mean = input_.mesh.patches()[i].area * (solution_.radiosity[i] - emission);
        of_step += glm::dot(mean, radiosity[i] - emission);
        of_mean += glm::dot(mean, solution_.radiosity[i] - emission);
    }
    const double level = of_mean > 0 ? of_step / of_mean : 0;
    const double before = solution_.steps > 1 ? level_ : 0;
    level_ = before + (level - before) / solution_.steps;
    if (solution_.steps > 1)
        level_squares_ += (level - before) * (level - level_);
}

/// A patch that no ray has struck shows no spread, though one ray more might have struck it: a
/// standard error is never below what one ray brings. Summed over all patches that would be too
/// much; the variances themselves are right on average. The error is that of single patches, of
/// which there are many, and that of the level, which is one and is known from few steps: its part
/// is reported larger than it shows (error_spread.h).
void StepwiseSolver::estimate_errors() {
    const double n = solution_.steps;
    const double level = level_squares_ / (n * (n - 1)); // its variance, relative
    const double level_freedom = std::max(n - 1, 2.0);   // one alone would bound nothing
    const double times = ErrorSpread{1, level_freedom}.reported(), more = times * times - 1;
    std::vector<Vec3> variance(squares_.size());
    std::vector<double> of_patch;
    double sum = 0, value = 0;
    for (std::uint32_t i = 0; i < variance.size(); ++i) {
        const double area = input_.mesh.patches()[i].area;
        const Vec3 reflected = solution_.radiosity[i] - input_.mesh.material(i).emission;
        variance[i] = squares_[i] / (n * (n - 1));
        of_patch.push_back(area * (variance[i].x + variance[i].y + variance[i].z));
        sum += of_patch.back();
        value += area * glm::dot(reflected, reflected);
    }
    variance = pooled_over_neighbours(input_.mesh, variance);
    const Vec3 purest = purest_ray();
    for (std::uint32_t i = 0; i < variance.size(); ++i) {
        Vec3& sigma = solution_.standard_error[i];
        const Vec3 reflected = solution_.radiosity[i] - input_.mesh.material(i).emission;
        sigma = glm::max(glm::sqrt(variance[i] + more * level * reflected * reflected), one_ray(i));
        const double area = input_.mesh.patches()[i].area;
        for (int c = 0; c < 3; ++c)
            if (variance[i][c] == 0 && area > 0) // nothing of this channel was seen around here
                sigma[c] =
                    std::max(sigma[c], input_.mesh.material(i).reflectance[c] * purest[c] / area);
    }
    solution_.variance = sum;
    solution_.variance_of_level = level * value;
    solution_.level_freedom = level_freedom;
    solution_.unseen = unseen();
    if (sum > 0)
        solution_.effective_freedom = effective_freedom_of(of_patch, 0);
}

/// What patches send by the solution and what rays have carried differ by chance: numbers of rays
/// are whole, and the series of bounces ends with the last ray.
void StepwiseSolver::account(const StepResult& result) {
    absorbed_ += result.absorbed.value();
    escaped_ += result.escaped.value();
    sent_ += result.sent.value();
    const double n = solution_.steps, to_world = input_.mesh.frame().area_to_world(1.0);
    solution_.energy.absorbed = to_world * (absorbed_.value() / n);
    solution_.energy.escaped = to_world * (escaped_.value() / n);
    solution_.energy.unshot = to_world * (power_leaving() - sent_.value() / n);
}

/// Emission, densities and the order of patches follow from the scene and are found again.
void StepwiseSolver::save(StateWriter& state) const {
    state.add(std::uint64_t{solution_.steps});
    state.add(solution_.rays_energy);
    state.add(solution_.seconds_density);
    for (const Vec3& power :
         {solution_.energy.absorbed, solution_.energy.escaped, solution_.energy.unshot,
          absorbed_.sum, absorbed_.lost, escaped_.sum, escaped_.lost, sent_.sum, sent_.lost})
        state.add(power);
    state.add(ray_power_);
    state.add(level_);
    state.add(level_squares_);
    state.add(std::span<const Vec3>(solution_.radiosity));
    state.add(std::span<const Vec3>(squares_));
    state.add(std::span<const std::uint64_t>(solution_.hits));
    save_more(state);
}

/// 0 before the pilot, infinite where rays are not equal. A step shoots about the emitted power, or
/// as many times as much as there are bounces (check_bounces).
void StepwiseSolver::load_ray_power(StateReader& state) {
    constexpr double least_times = 1e-3, most_times = 1e9;
    ray_power_ = state.number();
    const double once =
        emitted() / (input_.options.rays * static_cast<double>(input_.mesh.patches().size()));
    const bool equal = equal_rays_ && emitted() > 0;
    const bool fits = ray_power_ == 0 ? solution_.steps == 0
                      : equal ? ray_power_ >= least_times * once && ray_power_ <= most_times * once
                              : ray_power_ > bounds::largest;
    if (!fits)
        throw StateError("the power of a ray is none of this scene's");
}

void StepwiseSolver::load(StateReader& state) {
    const std::uint64_t steps = state.whole();
    if (steps > std::numeric_limits<std::uint32_t>::max())
        throw StateError("the number of steps is too large");
    solution_.steps = static_cast<std::uint32_t>(steps);
    solution_.rays_energy = state.whole();
    solution_.seconds_density += state.number({0, longest_seconds}); // both were spent
    for (Vec3* power :
         {&solution_.energy.absorbed, &solution_.energy.escaped, &solution_.energy.unshot,
          &absorbed_.sum, &absorbed_.lost, &escaped_.sum, &escaped_.lost, &sent_.sum, &sent_.lost})
        state.get(*power, bounds::finite);
    load_ray_power(state);
    level_ = state.number({-largest_radiosity, largest_radiosity});
    level_squares_ = state.number(bounds::non_negative);
    load_light(solution_.radiosity, largest_radiosity, state);
    state.get(std::span(squares_), bounds::non_negative);
    state.get(std::span(solution_.hits));
    std::uint64_t hits_left = solution_.rays_energy;
    for (const std::uint64_t hits : solution_.hits) {
        if (hits > hits_left)
            throw StateError("more rays arrived than were traced");
        hits_left -= hits;
    }
    if (solution_.steps > 1)
        estimate_errors();
    load_more(state);
}

} // namespace hemilux
