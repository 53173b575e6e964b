#include "radiosity/plain/step_mean.h"

#include "radiosity/rays/shot.h"
#include "radiosity/scene/alike_neighbours.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/solving/check_input.h"
#include "radiosity/solving/error_spread.h"
#include "radiosity/solving/solve_error.h"
#include "radiosity/solving/unseen_sights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux::plain {

Step::Step(const Mesh& of) : mesh(of), received(of.patches().size()), hits(of.patches().size()) {
    for (const Patch& patch : mesh.patches()) {
        radiosity.push_back(mesh.material(patch).emission);
        unshot.push_back(radiosity.back() * patch.area);
    }
}

std::uint32_t Step::receive(const std::optional<Hit>& hit, const Vec3& Phi_ray) {
    const std::uint32_t patch = hit ? mesh.patch_at(*hit) : none;
    ++rays;
    sent += Phi_ray;
    if (patch == none) {
        (hit ? absorbed : escaped) += Phi_ray;
        return none;
    }
    received[patch] += Phi_ray;
    ++hits[patch];
    return patch;
}

void Step::reflect() {
    for (std::uint32_t i = 0; i < received.size(); ++i) {
        const Vec3 Phi = received[i].value(), rho = mesh.material(i).reflectance;
        const double area = mesh.patches()[i].area;
        received[i] = {};
        absorbed += (1.0 - rho) * Phi;
        unshot[i] = rho * Phi;
        if (area > 0)
            radiosity[i] += unshot[i] / area;
    }
}

double Step::power_unshot() const {
    double sum = 0;
    for (const Vec3& Phi_patch : unshot)
        sum += mean_of_channels(Phi_patch);
    return sum;
}

StepMean::StepMean(const SolverInput& input, bool equal_rays)
    : input_(input), equal_rays_(equal_rays), squares_(input.mesh.patches().size(), Vec3(0.0)) {
    check_input(input);
    solution_.radiosity = Step(input.mesh).radiosity;
    solution_.hits.assign(squares_.size(), 0);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    solution_.standard_error.assign(squares_.size(), Vec3(input.needs.bounces ? unknown : 0));
    solution_.may_find_light = input.needs.bounces;
    solution_.energy.emitted = input.mesh.frame().area_to_world(1.0) * power_leaving();
    solution_.energy.unshot = solution_.energy.emitted;
}

bool StepMean::step() {
    if (Phi_mean_ == 0 && !find_Phi_mean())
        return false;
    input_.monitor.phase = "step";
    Step result(input_.mesh);
    if (!compute_radiosity(solution_.steps, Phi_mean_, result))
        return false;
    check_finite(input_.mesh, result.radiosity, "the radiosity", solution_.steps + 1);
    combine(result);
    return true;
}

/// N_hemi is the mean number of rays of a patch in a step. How much power all bounces carry
/// together depends on the scene; a pilot with few rays finds it, and no step uses its light (D16).
bool StepMean::find_Phi_mean() {
    const Mesh& mesh = input_.mesh;
    const double rays = input_.options.rays * double(squares_.size());
    const double pilot_rays = std::clamp(rays / 16, 1000.0, 400'000.0);
    const double emitted = mean_of_channels(power_leaving());
    if (!equal_rays_ || !(emitted > 0)) {
        Phi_mean_ = std::numeric_limits<double>::infinity();
        return true;
    }
    input_.monitor.phase = "pilot";
    double area = 0, reflected = 0;
    for (const Patch& patch : mesh.patches()) {
        area += patch.area;
        reflected += patch.area * mean_of_channels(mesh.material(patch).reflectance);
    }
    const double rho = std::min(reflected / area, .999);
    Step result(mesh);
    if (!compute_radiosity(pilot, emitted / (1 - rho) / pilot_rays, result))
        return false;
    solution_.rays_energy += result.rays;
    input_.monitor.rays += result.rays;
    Phi_mean_ = result.shot / rays;
    return true;
}

/// Mean and spread of the steps (Welford 1962).
void StepMean::combine(const Step& step) {
    input_.monitor.rays += step.rays;
    const double n = ++solution_.steps;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        const Vec3 B = step.radiosity[i], before = n > 1 ? solution_.radiosity[i] : Vec3(0.0);
        solution_.radiosity[i] = before + (B - before) / n;
        if (n > 1)
            squares_[i] += (B - before) * (B - solution_.radiosity[i]);
        solution_.hits[i] += step.hits[i];
    }
    solution_.rays_energy += step.rays;
    note_level(step);
    if (n > 1)
        estimate_errors();
    sent_ += step.sent.value();
    absorbed_ += step.absorbed.value();
    escaped_ += step.escaped.value();
    const double to_world = input_.mesh.frame().area_to_world(1.0);
    solution_.energy.absorbed = to_world * (absorbed_.value() / n);
    solution_.energy.escaped = to_world * (escaped_.value() / n);
    solution_.energy.unshot = to_world * (power_leaving() - sent_.value() / n);
}

/// How much of the mean's reflected light a step has: the error that all patches share.
void StepMean::note_level(const Step& step) {
    double of_step = 0, of_mean = 0;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        const Vec3 emission = input_.mesh.material(i).emission;
        const Vec3 mean = input_.mesh.patches()[i].area * (solution_.radiosity[i] - emission);
        of_step += glm::dot(mean, step.radiosity[i] - emission);
        of_mean += glm::dot(mean, solution_.radiosity[i] - emission);
    }
    const double level = of_mean > 0 ? of_step / of_mean : 0;
    const double before = solution_.steps > 1 ? level_ : 0;
    level_ = before + (level - before) / solution_.steps;
    if (solution_.steps > 1)
        level_squares_ += (level - before) * (level - level_);
}

/// A standard error is never below what one ray brings (D19).
void StepMean::estimate_errors() {
    const double n = solution_.steps;
    const double level = level_squares_ / (n * (n - 1)); // its variance, relative
    const double level_freedom = std::max(n - 1, 2.0);   // one alone would bound nothing
    const double times = ErrorSpread{1, level_freedom}.reported(), more = times * times - 1;
    std::vector<Vec3> variance;
    std::vector<double> of_patch;
    double sum = 0, value = 0;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        const double area = input_.mesh.patches()[i].area;
        const Vec3 reflected = solution_.radiosity[i] - input_.mesh.material(i).emission;
        const Vec3 of_mean = squares_[i] / (n * (n - 1));
        variance.push_back(of_mean);
        of_patch.push_back(area * (of_mean.x + of_mean.y + of_mean.z));
        sum += of_patch.back();
        value += area * glm::dot(reflected, reflected);
    }
    variance = pooled_over_neighbours(input_.mesh, variance);
    Vec3 purest(0.0); // the largest share of a ray's power that a channel may have
    for (const Facet& facet : input_.mesh.scene().facets) {
        const Vec3& emission = input_.mesh.scene().materials[facet.material].emission;
        if (emission != Vec3(0.0))
            purest = glm::max(purest, emission / mean_of_channels(emission));
    }
    purest = mean_of_channels(mean_ray()) * purest;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        Vec3& sigma = solution_.standard_error[i];
        const Vec3 reflected = solution_.radiosity[i] - input_.mesh.material(i).emission;
        sigma = glm::max(glm::sqrt(variance[i] + more * level * reflected * reflected), one_ray(i));
        const double area = input_.mesh.patches()[i].area;
        const Vec3 rho = input_.mesh.material(i).reflectance;
        for (int c = 0; c < 3; ++c)
            if (variance[i][c] == 0 && area > 0) // this channel was not seen around here
                sigma[c] = std::max(sigma[c], rho[c] * purest[c] / area);
    }
    solution_.variance = sum;
    solution_.variance_of_level = level * value;
    solution_.level_freedom = level_freedom;
    solution_.unseen = unseen();
    if (sum > 0)
        solution_.effective_freedom = effective_freedom_of(of_patch, 0);
}

Vec3 StepMean::power_leaving() const {
    CompensatedSum<Vec3> power;
    for (std::uint32_t i = 0; i < solution_.radiosity.size(); ++i)
        power += solution_.radiosity[i] * input_.mesh.patches()[i].area;
    return power.value();
}

/// The power of a ray in the mean of the steps.
Vec3 StepMean::mean_ray() const {
    const double emitted = mean_of_channels(solution_.energy.emitted);
    if (!equal_rays_ || !(emitted > 0))
        return Vec3(0.0);
    return Phi_mean_ / (emitted * solution_.steps) * solution_.energy.emitted;
}

/// What one ray adds to a patch: the mean of those that struck it, or one of mean power.
Vec3 StepMean::one_ray(std::uint32_t patch) const {
    const Material& material = input_.mesh.material(patch);
    const double area = input_.mesh.patches()[patch].area;
    if (equal_rays_ && solution_.hits[patch] > 0)
        return (solution_.radiosity[patch] - material.emission) / double(solution_.hits[patch]);
    return area > 0 ? material.reflectance * mean_ray() / area : Vec3(0.0);
}

/// Squared error, weighted by area, of light that no ray has met so far: three rays, each anywhere.
double StepMean::unseen() const {
    const Vec3 power = rule_of_three * mean_ray();
    double area = 0, squares = 0;
    for (std::uint32_t i = 0; i < squares_.size(); ++i) {
        const Vec3 reflected = input_.mesh.material(i).reflectance * power;
        area += input_.mesh.patches()[i].area;
        squares += glm::dot(reflected, reflected);
    }
    return squares / area;
}

} // namespace hemilux::plain
