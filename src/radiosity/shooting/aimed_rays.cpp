#include "radiosity/shooting/aimed_rays.h"

#include "radiosity/rays/shot.h"
#include "radiosity/scene/alike_neighbours.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/shooting/bounces.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace hemilux {
namespace {

/// Of the rays of importance; those of light have the task's.
constexpr std::uint64_t stream_of_importance = ~std::uint64_t{1};

/// So many rays that find the mean importance count with those of each patch: what few rays tell
/// must not leave a patch without any.
constexpr double prior_rays = 4;

/// The importance that rays from a patch have found, and their number.
struct Found {
    double importance = 0, rays = 0;

    Found& operator+=(const Found& other) {
        importance += other.importance;
        rays += other.rays;
        return *this;
    }
    [[nodiscard]] double mean() const { return rays > 0 ? importance / rays : 0; }
};

/// Rays by the cosine law, which find what light does for the target where they arrive.
class Watching final : public Strategy {
  public:
    /// By patch. Nothing is found without `importance`.
    Watching(std::span<const double> importance, std::span<Found> found)
        : importance_(importance), found_(found) {}

    Allocation allocate(std::uint32_t, AllocatedCells&) const override {
        static constexpr std::uint16_t cell = whole_hemisphere;
        static constexpr float all_rays = 1;
        return {{&cell, 1}, {&all_rays, 1}};
    }
    [[nodiscard]] bool learns() const override { return !importance_.empty(); }
    void learn(std::uint32_t patch, std::uint16_t, std::span<const std::uint32_t> receivers,
               std::span<const std::uint16_t>) override {
        for (const std::uint32_t receiver : receivers)
            found_[patch] += {receiver < importance_.size() ? importance_[receiver] : 0, 1};
    }
    void find_arrivals(std::span<const Ray> rays, std::span<const std::uint32_t>,
                       std::vector<std::uint16_t>& arrivals) const override {
        arrivals.resize(arrivals.size() + rays.size());
    }

  private:
    std::span<const double> importance_;
    std::span<Found> found_;
};

/// All bounces of the light that `result` has as radiosity; false when interrupted.
[[nodiscard]] bool shoot(const SolverInput& input, const StepTask& task, const Watching& watching,
                         StepResult& result) {
    const ShootingTools tools{input, Hemisphere(0), CellDirections(tools.hemisphere, false),
                              PatchStarts(input.mesh), std::make_unique<Watching>(watching)};
    return Bounces(tools).shoot(task, result);
}

double power_of(const Mesh& mesh, std::span<const Vec3> radiosity) {
    double power = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i)
        power += mesh.patches()[i].area * mean_of_channels(radiosity[i]);
    return power;
}

/// With what the patch's neighbours have found.
Found around(const Mesh& mesh, std::span<const Found> found, std::uint32_t patch) {
    Found sum = found[patch];
    for_alike_neighbours(mesh, patch, [&](std::uint32_t j) { sum += found[j]; });
    return sum;
}

/// The rays that the hits of importance stand for; none when interrupted.
std::vector<Found> shoot_importance(const SolverInput& input, StepTask task, std::uint64_t& rays) {
    const Mesh& mesh = input.mesh;
    StepResult result(mesh);
    const double power_of_light = power_of(mesh, result.radiosity);
    for (std::uint32_t i = 0; i < result.radiosity.size(); ++i)
        result.radiosity[i] = input.target[i] * mesh.material(i).reflectance;
    task.stream = stream_of_importance;
    task.ray_power *= power_of(mesh, result.radiosity) / power_of_light;
    if (!shoot(input, task, Watching({}, {}), result))
        return {};
    rays += result.rays;
    std::vector<Found> found;
    for (std::uint32_t i = 0; i < result.hits.size(); ++i)
        found.push_back({double(result.hits[i]), mesh.patches()[i].area / task.ray_power});
    return found;
}

/// The root of each patch's mean over that of all power.
std::vector<double> times_of(const Mesh& mesh, std::span<const Found> found,
                             std::span<const Vec3> radiosity) {
    const double power = power_of(mesh, radiosity);
    const auto power_shot = [&](std::uint32_t i) {
        return mesh.patches()[i].area * mean_of_channels(radiosity[i]);
    };
    double mean = 0, sum = 0;
    for (std::uint32_t i = 0; i < found.size(); ++i)
        mean += power_shot(i) / power * found[i].mean();
    std::vector<double> times;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        Found known = around(mesh, found, i);
        known += {prior_rays * mean, prior_rays};
        times.push_back(std::sqrt(known.mean()));
        sum += power_shot(i) / power * times[i];
    }
    for (double& each : times)
        each = sum > 0 ? each / sum : 1;
    return times;
}

} // namespace

std::vector<double> aim_rays(const SolverInput& input, const StepTask& task, StepResult& pilot) {
    std::vector<Found> found = shoot_importance(input, task, pilot.rays);
    std::vector<double> importance; // that light has where it arrives
    for (std::uint32_t i = 0; i < found.size(); ++i)
        importance.push_back(mean_of_channels(input.mesh.material(i).reflectance) *
                             (input.target[i] + around(input.mesh, found, i).mean()));
    if (found.empty() || !shoot(input, task, Watching(importance, found), pilot))
        return {};
    return times_of(input.mesh, found, pilot.radiosity);
}

} // namespace hemilux
