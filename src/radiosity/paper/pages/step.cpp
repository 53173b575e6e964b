#include "radiosity/paper/pages/step.h"

#include "radiosity/paper/hemisphere/density_direction.h"

#include <algorithm>
#include <cmath>

namespace hemilux::plain {

Rays rays_on_line(double N, double begin, double end) {
    const double whole = std::floor(end) - std::floor(begin);
    return {static_cast<std::uint64_t>(whole), N >= 1 ? whole : N};
}

Rays rays_on_line(const Due& due, double from, double to) {
    const auto place = [&](double share) {
        return share < 1 ? due.begin + due.rays() * share : due.end;
    };
    return rays_on_line(due.rays() * (to - from), place(from), place(to));
}

Rays rays_rounded(double N) {
    const double whole = std::round(N);
    return {static_cast<std::uint64_t>(whole), whole};
}

Step::Step(const SolverInput& of)
    : StepResult(of.mesh), input(of), received(of.mesh.patches().size()) {
    for (const Patch& patch : input.mesh.patches())
        unshot.push_back(input.mesh.material(patch).emission * patch.area);
}

std::vector<Due> Step::due(std::uint64_t stream, double Phi_mean) {
    shot += power_unshot();
    std::vector<Due> result;
    double line = Rng(stream).uniform();
    for (std::uint32_t i = 0; i < unshot.size(); ++i)
        if (const double Phi = mean_of_channels(unshot[i]); Phi > 0) {
            result.push_back({i, hash_words({stream, i}), line, line + Phi / Phi_mean});
            line = result.back().end;
        }
    return result;
}

std::uint32_t Step::shoot(const Ray& ray, const Vec3& Phi_ray) {
    const std::optional<Hit> hit = input.tracer.closest(ray);
    const std::uint32_t patch = hit ? input.mesh.patch_at(*hit) : none;
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

void Step::shoot(const Patch& from, const Vec3& start, const Vec3& direction, const Vec3& Phi_ray) {
    shoot({.origin = start, .direction = direction, .from = from.facet}, Phi_ray);
}

void Step::reflect() {
    for (std::uint32_t i = 0; i < received.size(); ++i) {
        const Vec3 Phi = received[i].value(), rho = input.mesh.material(i).reflectance;
        const double area = input.mesh.patches()[i].area;
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

/// N_hemi is the mean number of rays of a patch in a step. How much power all bounces carry
/// together depends on the scene; a pilot with few rays finds it, and no step uses its light
/// (docs/paper/decisions.md, D16).
bool StepSolver::step() {
    constexpr std::uint64_t pilot = ~std::uint64_t{0}; // steps count from 0
    const auto solve_pilot = [&](double Phi_mean, StepResult& result) {
        return solve_once(pilot, Phi_mean, result);
    };
    if (mean_.ray_power == 0 && !mean_.find_ray_power(solve_pilot))
        return false;
    input_.monitor.phase = "step";
    StepResult result;
    if (!solve_once(mean_.solution.steps, mean_.ray_power, result))
        return false;
    mean_.add(result);
    return true;
}

bool StepSolver::solve_once(std::uint64_t number, double Phi_mean, StepResult& result) {
    Step step(input_);
    if (!compute_radiosity(number, Phi_mean, step))
        return false;
    input_.monitor.rays += step.rays;
    result = std::move(step);
    return true;
}

std::uint8_t StepSolver::count_surfaces(std::uint32_t patch, const Vec3& from,
                                        const Vec3& direction) {
    const Frame frame = input_.mesh.hemisphere_frame(patch);
    const Ray ray{.origin = from,
                  .direction = frame.to_world(density_direction(direction)),
                  .from = input_.mesh.patches()[patch].facet};
    ++mean_.solution.rays_density;
    ++input_.monitor.rays;
    return static_cast<std::uint8_t>(std::min(input_.tracer.count(ray), 255U));
}

} // namespace hemilux::plain
