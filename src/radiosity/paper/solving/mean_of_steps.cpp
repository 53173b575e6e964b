#include "radiosity/paper/solving/mean_of_steps.h"

#include "geometry/elementary.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/error_spread.h"
#include "radiosity/paper/solution/missed_light.h"
#include "radiosity/paper/solution/solve_error.h"
#include "radiosity/paper/solving/check_input.h"

#include <algorithm>
#include <limits>

namespace hemilux {

StepResult::StepResult(const Mesh& mesh) : hits(mesh.patches().size()) {
    radiosity.reserve(mesh.patches().size());
    for (const Patch& patch : mesh.patches())
        radiosity.push_back(mesh.material(patch).emission);
}

MeanOfSteps::MeanOfSteps(const SolverInput& input, bool equal_rays)
    : solution(solution_before_steps(input)), input_(input), equal_rays_(equal_rays) {
    sums.squares.assign(input.mesh.patches().size(), Vec3(0.0));
}

double MeanOfSteps::ray_power_of_pilot() const {
    input_.monitor.phase = "pilot";
    const double rays = input_.options.rays * static_cast<double>(sums.squares.size());
    const double pilot_rays = std::clamp(rays / 16, 1000.0, 400'000.0);
    return emitted() / (1 - mean_reflectance(input_.mesh)) / pilot_rays;
}

void MeanOfSteps::set_ray_power(const StepResult& of_pilot) {
    const double rays = input_.options.rays * static_cast<double>(sums.squares.size());
    solution.rays_energy += of_pilot.rays;
    ray_power = needs_pilot() ? of_pilot.shot / rays : std::numeric_limits<double>::infinity();
}

/// Updates mean and spread by Welford (1962). What patches send by the solution and what rays have
/// carried differ by chance. Numbers of rays are whole, and the series of bounces ends with the
/// last ray.
void MeanOfSteps::add(const StepResult& step) {
    check_finite(input_.mesh, step.radiosity, "the radiosity", solution.steps + 1);
    const double n = ++solution.steps;
    for (std::uint32_t i = 0; i < step.radiosity.size(); ++i) {
        const Vec3 B = step.radiosity[i], before = n > 1 ? solution.radiosity[i] : Vec3(0.0);
        solution.radiosity[i] = before + (B - before) / n;
        if (n > 1)
            sums.squares[i] += (B - before) * (B - solution.radiosity[i]);
        solution.hits[i] += step.hits[i];
    }
    solution.rays_energy += step.rays;
    note_level(step.radiosity);
    if (n > 1)
        estimate_errors();
    sums.absorbed += step.absorbed.value();
    sums.escaped += step.escaped.value();
    sums.sent += step.sent.value();
    const double to_world = input_.mesh.frame().area_to_world(1.0);
    solution.energy.absorbed = to_world * (sums.absorbed.value() / n);
    solution.energy.escaped = to_world * (sums.escaped.value() / n);
    solution.energy.unshot = to_world * (power_leaving() - sums.sent.value() / n);
}

/// Notes how much of the reflected light of the mean a step has: the error that all patches share.
void MeanOfSteps::note_level(const std::vector<Vec3>& radiosity) {
    double of_step = 0, of_mean = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 emission = input_.mesh.material(i).emission;
        const Vec3 mean = weighted_area(i) * (solution.radiosity[i] - emission);
        of_step += glm::dot(mean, radiosity[i] - emission);
        of_mean += glm::dot(mean, solution.radiosity[i] - emission);
    }
    const double level = of_mean > 0 ? of_step / of_mean : 0;
    const double before = solution.steps > 1 ? sums.level : 0;
    sums.level = before + (level - before) / solution.steps;
    if (solution.steps > 1)
        sums.level_squares += (level - before) * (level - sums.level);
}

/// Sets the errors. A patch that no ray has hit shows no spread, though one more ray might have hit
/// it. So a standard error is never below what one ray brings. Summed over all patches that would
/// be too much; the variances themselves are right on average. The error is that of single patches,
/// of which there are many, and that of the level, which is one and is known from few steps. Its
/// part is reported larger than it shows (error_spread.h).
void MeanOfSteps::estimate_errors() {
    const double n = solution.steps;
    const double level_freedom = std::max(n - 1, 2.0); // one alone would bound nothing
    const double times = ErrorSpread{1, level_freedom}.reported(), more = times * times - 1;
    std::vector<Vec3> variance(sums.squares.size());
    std::vector<double> of_patch;
    double sum = 0, value = 0, alone = 0;
    for (std::uint32_t i = 0; i < variance.size(); ++i) {
        const double area = weighted_area(i);
        const Vec3 reflected = solution.radiosity[i] - input_.mesh.material(i).emission;
        variance[i] = sums.squares[i] / (n * (n - 1));
        of_patch.push_back(area * (variance[i].x + variance[i].y + variance[i].z));
        sum += of_patch.back();
        value += area * glm::dot(reflected, reflected);
        alone = elementary::hypot(alone, area * glm::dot(reflected, glm::sqrt(variance[i])));
    }
    // The level has this relative variance, less what patches that err independently make of it.
    const double shown = sums.level_squares / (n * (n - 1));
    const double of_patches = value > 0 ? (alone / value) * (alone / value) : 0;
    const double level = std::max(shown - of_patches, 0.0);
    variance = pooled_over_neighbours(input_.mesh, variance);
    const Vec3 purest = purest_ray();
    for (std::uint32_t i = 0; i < variance.size(); ++i) {
        Vec3& sigma = solution.standard_error[i];
        const Vec3 reflected = solution.radiosity[i] - input_.mesh.material(i).emission;
        sigma = glm::max(glm::sqrt(variance[i] + more * level * reflected * reflected), one_ray(i));
        const double area = input_.mesh.patches()[i].area;
        const Vec3& reflectance = input_.mesh.material(i).reflectance;
        for (int c = 0; c < 3; ++c)
            if (variance[i][c] == 0 && area > 0) // no light of this channel arrived around here
                sigma[c] = std::max(sigma[c], reflectance[c] * purest[c] / area);
    }
    solution.variance = sum;
    solution.variance_of_level = level * value;
    solution.level_freedom = level_freedom;
    solution.missed = missed();
    if (sum > 0)
        solution.effective_freedom = effective_freedom_of(of_patch, 0);
}

double MeanOfSteps::emitted() const {
    return mean_of_channels(solution.energy.emitted / input_.mesh.frame().area_to_world(1.0));
}

/// Returns the weight of the squared error of a patch [local area].
double MeanOfSteps::weighted_area(std::uint32_t patch) const {
    return solution.weight_of(patch) * input_.mesh.patches()[patch].area;
}

/// Returns the power that leaves the patches by the solution [W, local units].
Vec3 MeanOfSteps::power_leaving() const {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i)
        power += solution.radiosity[i] * input_.mesh.patches()[i].area;
    return power.value();
}

/// Returns the power of a ray in the mean of the steps, local units; 0 where rays have none in
/// common.
Vec3 MeanOfSteps::mean_ray() const {
    const double emitted_power = mean_of_channels(solution.energy.emitted);
    if (!equal_rays_ || !(emitted_power > 0))
        return Vec3(0.0);
    return ray_power / (emitted_power * solution.steps) * solution.energy.emitted;
}

/// Returns the most that a ray may bring of a channel: that of the emitter which shines in it most
/// purely.
Vec3 MeanOfSteps::purest_ray() const {
    Vec3 share(0.0);
    for (const Facet& facet : input_.mesh.scene().facets) {
        const Vec3& emission = input_.mesh.scene().materials[facet.material].emission;
        if (emission != Vec3(0.0))
            share = glm::max(share, emission / mean_of_channels(emission));
    }
    if (input_.mesh.scene().point_emitters) // patches emit what they reflect of those
        for (const Patch& patch : input_.mesh.patches())
            if (const Vec3& e = input_.mesh.material(patch).emission; e != Vec3(0.0))
                share = glm::max(share, e / mean_of_channels(e));
    return mean_of_channels(mean_ray()) * share;
}

/// Returns whether the squares of the steps are those of so few that all bring the same, and the
/// others nothing.
bool MeanOfSteps::is_of_few_steps(std::uint32_t patch) const {
    constexpr double few = 4;
    const Vec3 reflected = solution.radiosity[patch] - input_.mesh.material(patch).emission;
    const double n = solution.steps, of_mean = n * glm::dot(reflected, reflected);
    const Vec3& deviations = sums.squares[patch];
    return n * of_mean <= few * (of_mean + deviations.x + deviations.y + deviations.z);
}

/// Returns what a single ray of all steps so far has added to the patch's radiosity, on average.
/// Where none has hit it, returns what one of mean power would add, or where patches get fewer rays
/// one of theirs. It does so too where the few that have hit it were weak, as those of small cells
/// are. These show no spread of what a strong one would have brought.
Vec3 MeanOfSteps::one_ray(std::uint32_t patch) const {
    constexpr double weak = .5;
    const Material& material = input_.mesh.material(patch);
    const double area = input_.mesh.patches()[patch].area;
    const double power = aimed.empty() ? 1 : std::max(1 / aimed[patch], 1.0);
    const Vec3 of_mean_power =
        area > 0 ? power * material.reflectance * mean_ray() / area : Vec3(0.0);
    if (!equal_rays_ || solution.hits[patch] == 0)
        return of_mean_power;
    const Vec3 each =
        (solution.radiosity[patch] - material.emission) / static_cast<double>(solution.hits[patch]);
    const bool were_weak = mean_of_channels(each) < weak * mean_of_channels(of_mean_power);
    return were_weak && is_of_few_steps(patch) ? of_mean_power : each;
}

/// Returns the squared error, weighted by area, of light that no ray has met so far. By the rule of
/// three it is that of three more rays of mean power, each of which may hit any patch that counts.
double MeanOfSteps::missed() const {
    const Vec3 power = rule_of_three * mean_ray();
    double area = 0, squares = 0;
    for (std::uint32_t i = 0; i < sums.squares.size(); ++i) {
        const Vec3 reflected = solution.weight_of(i) * input_.mesh.material(i).reflectance * power;
        area += weighted_area(i);
        squares += glm::dot(reflected, reflected);
    }
    return squares / area;
}

} // namespace hemilux
