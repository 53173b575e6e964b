#include "support/families/reliability.h"

#include "geometry/compensated_sum.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "support/families/watchdog.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace hemilux::test {
namespace {

/// The error that the reference itself may have, in the measure of true_error().
double reference_error(const PreparedScene& scene) {
    double error = 0, value = 0;
    for (std::uint32_t i = 0; i < scene.hard().reference.size(); ++i) {
        const double area = scene.mesh().patches()[i].area;
        const Vec3& e = scene.hard().reference_error[i];
        const Vec3 reflected = scene.hard().reference[i] - scene.mesh().material(i).emission;
        error += area * glm::dot(e, e);
        value += area * glm::dot(reflected, reflected);
    }
    return value > 0 ? std::sqrt(error / value) : 0;
}

/// The mean of a part against its standard error, taken as if all patches erred the same way, which
/// is the most that they can. Rounding does not count.
void judge_part(const PreparedScene& scene, const Solution& solution,
                const std::vector<std::uint32_t>& part, JudgedRun& run) {
    constexpr double rounding = 1e-6;
    for (int c = 0; c < 3; ++c) {
        CompensatedSum<double> off;
        double sigma = 0, of_reference = 0, value = 0;
        for (const std::uint32_t i : part) {
            const double area = scene.mesh().patches()[i].area;
            const double right = scene.hard().reference[i][c];
            off += area * (solution.radiosity[i][c] - right);
            sigma += area * solution.standard_error[i][c];
            of_reference += area * scene.hard().reference_error[i][c];
            value += area * (right - scene.mesh().material(i).emission[c]);
        }
        if (solution.steps == 0 || !std::isfinite(sigma))
            run.part_unknown = true;
        else if (std::abs(off.value()) >
                 part_errors * sigma + part_errors * of_reference + rounding * value)
            run.part_wrong = true;
    }
}

void add_coverage(const PreparedScene& scene, const Solution& solution, JudgedRun& run) {
    constexpr std::uint64_t often = 30;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            if (!(solution.standard_error[i][c] > 0))
                continue;
            const double sigma =
                std::hypot(solution.standard_error[i][c], scene.hard().reference_error[i][c]);
            (solution.hits[i] >= often ? run.often : run.seldom)
                .add((solution.radiosity[i][c] - scene.hard().reference[i][c]) / sigma);
        }
}

double relative_bias(const PreparedScene& scene, const Solution& solution) {
    CompensatedSum<double> off, value;
    for (std::uint32_t i = 0; i < solution.radiosity.size(); ++i) {
        const double area = scene.mesh().patches()[i].area;
        const Vec3 one(1.0);
        off += area * glm::dot(one, solution.radiosity[i] - scene.hard().reference[i]);
        value +=
            area * glm::dot(one, scene.hard().reference[i] - scene.mesh().material(i).emission);
    }
    return off.value() / value.value();
}

double median(std::vector<double> values) {
    if (values.empty())
        return std::numeric_limits<double>::quiet_NaN();
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

} // namespace

PreparedScene::PreparedScene(const HardScene& hard)
    : hard_(hard), mesh_(layered_mesh(hard.scene, hard.options)), needs_(find_needs(mesh_)),
      made_(make_tracer(mesh_)) {}

void Coverage::add(double score) {
    ++count;
    within_2 += std::abs(score) <= 2;
    within_3 += std::abs(score) <= 3;
}

void Coverage::add(const Coverage& other) {
    count += other.count;
    within_2 += other.within_2;
    within_3 += other.within_3;
}

StopRule stop_rule(const Method& method, std::optional<double> error) {
    if (error)
        return {.steps = {}, .seconds = {}, .error = error};
    StopRule stop = method.default_stop;
    if (!stop.steps && !stop.seconds && !stop.error)
        stop.steps = StopRule::default_steps;
    return stop;
}

JudgedRun judge(const PreparedScene& scene, const Solution& solution) {
    JudgedRun run;
    run.true_error = true_error(scene.mesh(), solution.radiosity, scene.hard().reference).all;
    run.reported = estimated_error(scene.mesh(), solution);
    // Before the first step a solution holds emission alone and claims nothing.
    run.unknown = solution.steps == 0 || !std::isfinite(run.reported);
    constexpr double rounding = 1e-7; // of tracing and of references that are closed forms
    run.wrong = !run.unknown &&
                !(run.true_error <=
                  wrong_factor * std::hypot(run.reported, reference_error(scene)) + rounding);
    for (const std::vector<std::uint32_t>& part : scene.hard().parts)
        judge_part(scene, solution, part, run);
    add_coverage(scene, solution, run);
    run.bias = relative_bias(scene, solution);
    run.rays = solution.rays_energy + solution.rays_density;
    return run;
}

JudgedRun judge_run(const PreparedScene& scene, const Method& method, const StopRule& stop,
                    std::uint64_t seed, unsigned threads, const RunLimits& limits) {
    SolveOptions options;
    options.seed = seed;
    options.threads = threads;
    options.stop = stop;
    options.memory = std::uint64_t{4} << 30;
    const auto start = std::chrono::steady_clock::now();
    Monitor monitor;
    const Watchdog watchdog(monitor, limits.seconds, limits.rays);
    const SolverInput input{scene.mesh(), scene.tracer(), options, monitor, scene.needs()};
    JudgedRun judged;
    try {
        const auto solver = method.make(input);
        const bool completed = run(*solver, input, stop);
        judged = judge(scene, solver->solution());
        judged.stopped = !completed;
    } catch (const SolveError&) {
        judged.refused = judged.unknown = judged.part_unknown = true;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    judged.seconds = took.count();
    return judged;
}

Reliability summary(const std::vector<JudgedRun>& runs) {
    Reliability all;
    std::vector<double> true_errors, reported, rays, seconds;
    double true_squares = 0, reported_squares = 0;
    for (const JudgedRun& run : runs) {
        ++all.runs;
        all.wrong += run.wrong;
        all.unknown += run.unknown;
        all.parts_wrong += run.part_wrong;
        all.parts_unknown += run.part_unknown;
        all.stopped += run.stopped;
        all.refused += run.refused;
        all.often.add(run.often);
        all.seldom.add(run.seldom);
        all.bias += run.bias / double(runs.size());
        rays.push_back(double(run.rays));
        seconds.push_back(run.seconds);
        if (run.unknown)
            continue;
        true_errors.push_back(run.true_error);
        reported.push_back(run.reported);
        true_squares += run.true_error * run.true_error;
        reported_squares += run.reported * run.reported;
    }
    all.median_true = median(true_errors);
    all.median_reported = median(reported);
    all.rms_ratio = std::sqrt(true_squares / reported_squares);
    all.median_rays = median(rays);
    all.median_seconds = median(seconds);
    return all;
}

} // namespace hemilux::test
