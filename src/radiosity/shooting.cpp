#include "radiosity/shooting.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemilux {
namespace {

/// What decides how many rays a power in three channels is worth.
double scalar(const Vec3& power) { return (power.x + power.y + power.z) / 3; }

/// A direction with density cos(theta) / pi: uniform on the disc, lifted to the hemisphere.
Vec3 sample_cosine(Rng& rng) {
    const double r2 = rng.uniform(), phi = 2 * std::numbers::pi * rng.uniform();
    const double r = std::sqrt(r2);
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r2)};
}

/// Weighted by area; at most .999, so that 1 / (1 - rho) remains a number of use.
double mean_reflectance(const Mesh& mesh) {
    double area = 0, sum = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        area += mesh.patches()[i].area;
        sum += mesh.patches()[i].area * scalar(mesh.material(i).reflectance);
    }
    return area > 0 ? std::min(sum / area, .999) : 0;
}

/// Patches that one thread takes at a time, and patches whose rays are kept until they are summed.
constexpr std::size_t patches_per_volley = 32;
constexpr double rays_per_batch = 2e6;
/// Fewer rays than this are traced sooner than other threads would be started.
constexpr double rays_for_one_thread = 2000;

/// The pilot's stream; steps count from 0.
constexpr std::uint64_t pilot_stream = ~std::uint64_t{0};

/// Literal steps shoot as many rays for the last of the power as for the first; they end when this
/// share of the emitted power is left.
constexpr double literal_rest = 1e-4;

} // namespace

ShootingSolver::ShootingSolver(const SolverInput& input, MakeStrategy make_strategy)
    : input_(input), workers_(input.options.threads), hemisphere_(input.options.depth) {
    const auto start = std::chrono::steady_clock::now();
    input_.monitor.phase = "density";
    strategy_ = make_strategy(input_, hemisphere_, workers_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;

    const auto patches = input_.mesh.patches();
    solution_.seconds_density = elapsed.count();
    solution_.rays_density = strategy_->density_rays();
    solution_.bytes_density = strategy_->density_bytes();
    solution_.standard_error.assign(patches.size(), Vec3(std::numeric_limits<double>::quiet_NaN()));
    solution_.hits.assign(patches.size(), 0);
    squares_.assign(patches.size(), Vec3(0.0));
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        solution_.radiosity.push_back(input_.mesh.material(i).emission);
        solution_.energy.emitted += solution_.radiosity[i] * patches[i].area;
    }
    solution_.energy.emitted = input_.mesh.frame().area_to_world(1.0) * solution_.energy.emitted;
}

bool ShootingSolver::step() {
    if (ray_power_ == 0 && !find_ray_power())
        return false;
    input_.monitor.phase = "step";
    std::vector<Vec3> radiosity;
    StepTally tally;
    if (!solve_once(solution_.steps, radiosity, tally))
        return false;
    combine(radiosity, tally);
    return true;
}

/// All bounces together carry several times the emitted power; how many depends on the scene. A
/// pilot of few rays finds it, so that a step shoots as many rays as were asked for. The power per
/// ray is then the same in all steps, which keeps them independent and equally weighted.
bool ShootingSolver::find_ray_power() {
    input_.monitor.phase = "pilot";
    const auto patches = static_cast<double>(input_.mesh.patches().size());
    const double rays = input_.options.rays * patches;
    const double pilot_rays = std::clamp(rays / 16, 1000.0, 400'000.0);
    const Vec3 emitted = solution_.energy.emitted / input_.mesh.frame().area_to_world(1.0);
    if (input_.options.literal || !(scalar(emitted) > 0)) {
        ray_power_ = std::numeric_limits<double>::infinity();
        return true;
    }
    ray_power_ = scalar(emitted) / (1 - mean_reflectance(input_.mesh)) / pilot_rays;
    std::vector<Vec3> radiosity;
    StepTally tally;
    if (!solve_once(pilot_stream, radiosity, tally)) {
        ray_power_ = 0;
        return false;
    }
    solution_.rays_energy += tally.rays;
    ray_power_ = tally.shot / rays;
    return true;
}

bool ShootingSolver::solve_once(std::uint64_t stream, std::vector<Vec3>& radiosity,
                                StepTally& tally) {
    const auto patches = input_.mesh.patches();
    radiosity.resize(patches.size());
    tally.hits.assign(patches.size(), 0);
    std::vector<Vec3> unshot(patches.size()), received(patches.size());
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        radiosity[i] = input_.mesh.material(i).emission;
        unshot[i] = radiosity[i] * patches[i].area;
    }
    const double emitted =
        scalar(solution_.energy.emitted / input_.mesh.frame().area_to_world(1.0));
    for (std::uint64_t bounces = 0;; ++bounces) {
        double left = 0;
        for (const Vec3& power : unshot)
            left += scalar(power);
        if (!(left > (input_.options.literal ? literal_rest * emitted : 0.0)))
            return true;
        tally.shot += left;
        std::ranges::fill(received, Vec3(0.0));
        const std::uint64_t rays =
            bounce(hash_words({input_.options.seed, stream, bounces}), unshot, received, tally);
        if (input_.monitor.interrupted)
            return false;
        if (rays == 0) // what was left is below one ray, and chance has ended it
            return true;
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const Vec3& reflectance = input_.mesh.material(i).reflectance;
            tally.absorbed += (1.0 - reflectance) * received[i];
            unshot[i] = reflectance * received[i];
            if (patches[i].area > 0)
                radiosity[i] += unshot[i] / patches[i].area;
        }
    }
}

std::uint64_t ShootingSolver::bounce(std::uint64_t stream, const std::vector<Vec3>& unshot,
                                     std::vector<Vec3>& received, StepTally& tally) {
    plan(stream, unshot);
    const std::size_t patches = unshot.size();
    const std::uint64_t before = tally.rays;
    const double planned = rays_before_[patches] - rays_before_[0];
    const Workers workers = planned < rays_for_one_thread ? Workers(1) : workers_;
    std::vector<Volley> volleys;
    for (std::size_t begin = 0; begin < patches;) {
        std::size_t end = begin;
        while (end < patches && rays_before_[end] - rays_before_[begin] <= rays_per_batch)
            end = std::min(end + patches_per_volley, patches);
        volleys.resize((end - begin + patches_per_volley - 1) / patches_per_volley);
        workers.for_chunks(end - begin, patches_per_volley,
                           [&](std::size_t first, std::size_t last) {
                               Volley& volley = volleys[first / patches_per_volley];
                               volley.bursts.clear();
                               volley.receivers.clear();
                               if (input_.monitor.interrupted)
                                   return;
                               std::vector<CellShare> shares;
                               for (std::size_t i = begin + first; i < begin + last; ++i)
                                   if (scalar(unshot[i]) > 0)
                                       shoot(static_cast<std::uint32_t>(i), stream, shares, volley);
                               input_.monitor.rays += volley.receivers.size();
                           });
        for (const Volley& volley : volleys)
            receive(volley, unshot, received, tally);
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(tally.rays) /
                              (input_.options.rays * static_cast<double>(patches)));
        begin = end;
    }
    return tally.rays - before;
}

/// Rays in proportion to the power to be shot. Patch i owns the interval from rays_before_[i] to
/// rays_before_[i+1] of a line on which a ray stands at each whole number: as the line's origin is
/// random, each patch and each cell gets its expected number on average, rounded up or down.
void ShootingSolver::plan(std::uint64_t stream, const std::vector<Vec3>& unshot) {
    rays_before_.resize(unshot.size() + 1);
    rays_before_[0] = Rng(stream).uniform();
    for (std::size_t i = 0; i < unshot.size(); ++i) {
        const double power = scalar(unshot[i]);
        const double rays =
            input_.options.literal ? (power > 0 ? input_.options.rays : 0) : power / ray_power_;
        rays_before_[i + 1] = rays_before_[i] + rays;
    }
}

void ShootingSolver::shoot(std::uint32_t patch, std::uint64_t stream,
                           std::vector<CellShare>& shares, Volley& volley) const {
    const double before = rays_before_[patch], after = rays_before_[patch + 1];
    const bool literal = input_.options.literal;
    if (!literal && std::floor(after) == std::floor(before))
        return;
    strategy_->deal(patch, shares);
    Rng rng(hash_words({stream, patch}));
    const Frame frame = input_.mesh.hemisphere_frame(patch);
    double dealt = 0; // share of the patch's rays that the cells so far own
    double low = std::floor(before);
    for (const CellShare& share : shares) {
        dealt += share.rays;
        const bool last = &share == &shares.back();
        const double high =
            std::floor(last ? after : before + (after - before) * std::min(dealt, 1.0));
        const double expected = (after - before) * share.rays; // N_tr
        const double n = literal ? std::round(expected) : high - low;
        low = high;
        if (!(n > 0))
            continue;
        // Below one ray per cell, the ray that is shot carries the power of those that are not.
        const double ray_power = share.power / (literal || expected >= 1 ? n : expected);
        volley.bursts.push_back({patch, static_cast<std::uint32_t>(n), ray_power});
        for (double k = 0; k < n; ++k)
            volley.receivers.push_back(trace(patch, frame, share.cell, rng));
    }
}

std::uint32_t ShootingSolver::trace(std::uint32_t patch, const Frame& frame, std::uint16_t cell,
                                    Rng& rng) const {
    const Patch& from = input_.mesh.patches()[patch];
    Ray ray{};
    ray.from = from.facet;
    ray.origin = from.centre;
    if (!input_.options.literal) {
        const double u = rng.uniform(), v = rng.uniform();
        ray.origin = from.shape.sample({u, v});
    }
    ray.direction = frame.to_world(
        cell == whole_hemisphere
            ? sample_cosine(rng)
            : hemisphere_.cells()[cell].shape.sample_rejection([&] { return rng.uniform(); }));
    const auto hit = input_.tracer.closest(ray);
    if (!hit)
        return escaped;
    const std::uint32_t receiver = input_.mesh.patch_at(*hit);
    return receiver == none ? absorbed : receiver;
}

void ShootingSolver::receive(const Volley& volley, const std::vector<Vec3>& unshot,
                             std::vector<Vec3>& received, StepTally& tally) {
    std::size_t ray = 0;
    for (const Burst& burst : volley.bursts) {
        const Vec3 power = burst.ray_power * unshot[burst.patch]; // Phi_ray
        for (std::uint32_t k = 0; k < burst.rays; ++k) {
            const std::uint32_t receiver = volley.receivers[ray++];
            if (receiver == escaped) {
                tally.escaped += power;
            } else if (receiver == absorbed) {
                tally.absorbed += power;
            } else {
                received[receiver] += power;
                ++tally.hits[receiver];
            }
        }
    }
    tally.rays += ray;
}

/// What a single ray of all steps so far would add to the patch's radiosity.
Vec3 ShootingSolver::one_ray(std::uint32_t patch) const {
    const double area = input_.mesh.patches()[patch].area;
    const double emitted = scalar(solution_.energy.emitted);
    if (input_.options.literal || !(emitted > 0) || !(area > 0))
        return Vec3(0.0);
    const Vec3 power = ray_power_ / emitted * solution_.energy.emitted;
    return input_.mesh.material(patch).reflectance * power / (area * solution_.steps);
}

/// Mean and spread of the steps. A patch that no ray has struck shows no spread, though one ray
/// more might have struck it: a standard error is never below what one ray brings.
void ShootingSolver::combine(const std::vector<Vec3>& radiosity, const StepTally& tally) {
    const double n = ++solution_.steps;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i) {
        const Vec3 before = n > 1 ? solution_.radiosity[i] : Vec3(0.0);
        solution_.radiosity[i] = before + (radiosity[i] - before) / n;
        solution_.hits[i] += tally.hits[i];
        if (n > 1) {
            squares_[i] += (radiosity[i] - before) * (radiosity[i] - solution_.radiosity[i]);
            solution_.standard_error[i] =
                glm::max(glm::sqrt(squares_[i] / (n * (n - 1))), one_ray(i));
        }
    }
    solution_.rays_energy += tally.rays;
    power_absorbed_ += tally.absorbed;
    power_escaped_ += tally.escaped;
    const double to_world = input_.mesh.frame().area_to_world(1.0);
    solution_.energy.absorbed = to_world / n * power_absorbed_;
    solution_.energy.escaped = to_world / n * power_escaped_;
}

} // namespace hemilux
