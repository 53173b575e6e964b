#include "radiosity/research/targets/aimed_rays.h"

#include "radiosity/engine/shooting/bounces.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace hemilux {
namespace {

/// The stream of the rays of importance; rays of light use the task's stream.
constexpr std::uint64_t stream_of_importance = ~std::uint64_t{1};

/// Each patch is assumed to have found this much importance more, by rays of the mean importance.
/// Otherwise a patch with few rays could be left without any importance.
constexpr double prior_importance = .5;

/// The share of sqrt(J) that counts for rays which are not aimed. All of it is the most that they
/// may count; they count less, as the light of many patches adds up. Values between an eighth and a
/// half change little.
constexpr double root_of_unaimed = .25;

/// A ball gets rays of its own if they are more than this many times those that would pass through
/// it anyway.
constexpr double min_times_of_ball = 3;

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

/// A strategy that shoots rays by the cosine law and records what light does for the target where
/// they arrive.
class ArrivalsRecorder final : public Strategy, StepHook {
  public:
    /// Both spans are by patch. With an empty `importance` nothing is recorded.
    ArrivalsRecorder(std::span<const double> importance, std::span<Found> found)
        : importance_(importance), found_(found) {}

    Allocation allocate(std::uint32_t, AllocatedCells&) const override {
        static constexpr std::uint16_t cell = whole_hemisphere;
        static constexpr double all_rays = 1;
        return {{&cell, 1}, {&all_rays, 1}};
    }
    [[nodiscard]] StepHook* step_hook() override { return this; }
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

/// Shoots the light that `result` has as radiosity, and all its bounces. Returns false when
/// interrupted.
[[nodiscard]] bool shoot(const SolverInput& input, const StepTask& task,
                         const ArrivalsRecorder& recorder, StepResult& result) {
    const ShootingTools tools(input, ShootingRules{}, 0,
                              std::make_unique<ArrivalsRecorder>(recorder));
    return Bounces(tools).shoot(task, result);
}

double power_of(const Mesh& mesh, std::uint32_t patch, const Vec3& radiosity) {
    return mesh.patches()[patch].area * mean_of_channels(radiosity);
}

double power_of(const Mesh& mesh, std::span<const Vec3> radiosity) {
    double power = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i)
        power += power_of(mesh, i, radiosity[i]);
    return power;
}

/// Returns the mean of value(patch), weighted by the power of the patches.
template <class Value>
double mean_of_power(const Mesh& mesh, std::span<const Vec3> radiosity, const Value& value) {
    double sum = 0;
    for (std::uint32_t i = 0; i < radiosity.size(); ++i)
        sum += power_of(mesh, i, radiosity[i]) * value(i);
    return sum / power_of(mesh, radiosity);
}

/// Returns what the patch and those of its neighbours that are alike have found.
Found around(const Mesh& mesh, std::span<const Found> found, std::uint32_t patch) {
    Found sum = found[patch];
    for_alike_neighbours(mesh, patch, [&](std::uint32_t j) { sum += found[j]; });
    return sum;
}

/// Returns u by patch, divided by its own mean, so that a ray which finds the target finds about 1.
std::vector<double> source_of(const SolverInput& input) {
    std::vector<double> source;
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < input.target.size(); ++i) {
        const double area = input.mesh.patches()[i].area;
        const double rho = mean_of_channels(input.mesh.material(i).reflectance);
        source.push_back(area > 0 ? input.target[i] * rho / area : 0);
        sum += area * source[i];
        squares += area * source[i] * source[i];
    }
    for (double& each : source)
        each *= squares > 0 ? sum / squares : 0;
    return source;
}

/// Returns by patch the importance and the rays that the hits of importance stand for; none when
/// interrupted.
std::vector<Found> shoot_importance(const SolverInput& input, std::span<const double> source,
                                    StepTask task, std::uint64_t& rays) {
    const Mesh& mesh = input.mesh;
    StepResult result(mesh);
    const double power_of_light = power_of(mesh, result.radiosity);
    for (std::uint32_t i = 0; i < source.size(); ++i)
        result.radiosity[i] = source[i] * mesh.material(i).reflectance;
    task.stream = stream_of_importance;
    task.ray_power *= power_of(mesh, result.radiosity) / power_of_light;
    if (!shoot(input, task, ArrivalsRecorder({}, {}), result))
        return {};
    rays += result.rays;
    std::vector<Found> found;
    for (std::uint32_t i = 0; i < result.hits.size(); ++i)
        found.push_back({double(result.hits[i]), mesh.patches()[i].area / task.ray_power});
    return found;
}

/// Returns the root of each patch's importance, divided by the mean root; all are 1 if no light was
/// seen to reach the target.
std::vector<double> times_of(const Mesh& mesh, std::span<const Found> found,
                             std::span<const Vec3> radiosity) {
    const auto mean = [&](const auto& value) { return mean_of_power(mesh, radiosity, value); };
    const double mean_importance = mean([&](std::uint32_t i) { return found[i].mean(); });
    std::vector<double> times(found.size(), 1);
    if (!(mean_importance > 0))
        return times;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        Found known = around(mesh, found, i);
        known += {prior_importance, prior_importance / mean_importance};
        times[i] = std::sqrt(known.mean());
    }
    const double mean_times = mean([&](std::uint32_t i) { return times[i]; });
    for (double& each : times)
        each /= mean_times;
    return times;
}

/// Gives rays to the balls, and as many fewer to all other directions.
void aim_at_balls(const SolverInput& input, const Workers& workers, std::span<const Found> found,
                  StepResult& pilot, Aim& aim) {
    const auto mean = [&](const auto& of_patch) {
        return mean_of_power(input.mesh, pilot.radiosity, of_patch);
    };
    const std::vector<double> value = values_of_arrival(input);
    TargetBalls balls(input.mesh, value);
    const TargetBalls::Visibility visibility = balls.look(input, value, workers);
    pilot.rays += visibility.rays;
    const std::size_t count = balls.count();
    const double unaimed =
        root_of_unaimed * mean([&](std::uint32_t i) { return std::sqrt(found[i].mean()); });
    std::vector<double> due;
    for (std::size_t k = 0; k < count; ++k)
        due.push_back(
            mean([&](std::uint32_t i) { return visibility.root_of_value[i * count + k]; }));
    double all = unaimed;
    for (const double each : due)
        all += each;
    double kept = unaimed;
    for (std::size_t k = 0; k < count; ++k) {
        const double anyway =
            mean([&](std::uint32_t i) { return visibility.power[i * count + k]; });
        if (!(due[k] > min_times_of_ball * anyway * all))
            due[k] = 0;
        kept += due[k];
    }
    if (!(unaimed > 0) || !(kept > unaimed))
        return;
    for (double& times : aim.times)
        times *= unaimed / kept;
    for (std::size_t at = 0; at < balls.times().size(); ++at)
        balls.times()[at] = due[at % count] > 0 ? visibility.root_of_value[at] / kept : 0;
    aim.balls = std::move(balls);
}

} // namespace

std::vector<double> values_of_arrival(const SolverInput& input) {
    std::vector<double> value = source_of(input);
    for (std::uint32_t i = 0; i < value.size(); ++i)
        value[i] *= mean_of_channels(input.mesh.material(i).reflectance);
    return value;
}

Aim aim_rays(const SolverInput& input, const StepTask& task, bool balls, StepResult& pilot) {
    const std::vector<double> source = source_of(input);
    std::vector<Found> found = shoot_importance(input, source, task, pilot.rays);
    std::vector<double> importance; // of light that arrives
    for (std::uint32_t i = 0; i < found.size(); ++i)
        importance.push_back(mean_of_channels(input.mesh.material(i).reflectance) *
                             (source[i] + around(input.mesh, found, i).mean()));
    if (found.empty() || !shoot(input, task, ArrivalsRecorder(importance, found), pilot))
        return {};
    Aim aim{times_of(input.mesh, found, pilot.radiosity), {}};
    if (balls)
        aim_at_balls(input, task.workers, found, pilot, aim);
    return aim;
}

} // namespace hemilux
