#include "radiosity/division/adaptive_division.h"

#include "radiosity/division/inherited.h"
#include "radiosity/division/patch_levels.h"
#include "radiosity/final_gather/division_error.h"
#include "radiosity/final_gather/light_within_patches.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/scene/needs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

constexpr unsigned most_rounds = 20;

/// A round makes so many times more patches at the most, as what varies is known but roughly.
/// At the least, as it costs as much as the patches that it would spare.
constexpr double most_growth = 4, least_growth = 1.25;
constexpr std::size_t least_room = 256;

/// Of points on large patches: when they are new, and in further rounds.
constexpr unsigned rows_at_first = 6, rows_again = 3;

/// The light is solved anew when there are so many times more patches than were solved.
constexpr double solved_at_growth = 6;

/// The rough solution's error: most of it is gone once the light is reflected.
constexpr double least_rough_error = .02, most_rough_error = .05;

/// What is known of the patches.
class Division {
  public:
    Division(Mesh& mesh, const Tracer& tracer, Solution& solution, const AdaptiveDivision& options,
             Monitor& monitor)
        : mesh_(mesh), tracer_(tracer), solution_(solution), options_(options), monitor_(monitor),
          workers_(options.threads), square_(mesh.patches().size()), times_(mesh.patches().size()),
          solved_(mesh.patches().size()) {}

    [[nodiscard]] std::size_t patches() const { return mesh_.patches().size(); }

    /// Whether there is a rough solution.
    [[nodiscard]] bool solve_if_due() {
        rays_ = 0;
        if (double(patches()) < solved_at_growth * double(solved_))
            return true;
        Solution solution = rough_solution(mesh_, tracer_, options_, monitor_);
        if (solution.steps == 0)
            return false;
        rays_ = solution.rays_energy;
        solution_ = std::move(solution);
        solved_ = patches();
        return true;
    }
    /// What varies within patches. Each is measured in each round, by new points: where a few
    /// points miss something once, the patch must not count as even for ever.
    void measure(std::uint64_t seed) {
        monitor_.phase = "dividing";
        fresh_ = fresh_squares_ = 0;
        for (const bool is_new : {true, false}) {
            std::vector<std::uint32_t> some;
            for (std::uint32_t i = 0; i < patches(); ++i)
                if ((times_[i] == 0) == is_new)
                    some.push_back(i);
            measure(some, is_new ? rows_at_first : rows_again, hash_words({seed, is_new}));
        }
    }
    [[nodiscard]] DivisionRound round() const {
        return {patches(), std::sqrt(std::max(fresh_, 0.0) / size()), rays_};
    }
    /// Whether the division is done, and that is known: few points may miss what few patches hold,
    /// whose squares then scatter.
    [[nodiscard]] bool is_done() const {
        constexpr double doubt = .5;
        const double most = fresh_ + doubt * std::sqrt(fresh_squares_);
        return most <= options_.error * options_.error * size();
    }
    /// False where nothing can be divided.
    [[nodiscard]] bool divide() {
        const auto times = [&](double growth) {
            return static_cast<std::size_t>(growth * double(patches()));
        };
        const std::vector<std::uint8_t> levels = levels_of_division(
            square_,
            {.goal = options_.error * options_.error * size(),
             .least_pieces = times(least_growth),
             .most_pieces = std::min(options_.most_patches, times(most_growth) + least_room)});
        if (std::ranges::none_of(levels, [](std::uint8_t level) { return level > 0; }))
            return false;
        const std::size_t before = patches();
        const std::vector<std::uint32_t> parents = mesh_.refine(levels);
        std::vector<std::uint32_t> pieces(before);
        for (const std::uint32_t parent : parents)
            ++pieces[parent];
        square_ = inherited(square_, parents);
        times_ = inherited(times_, parents);
        for (std::size_t k = 0; k < parents.size(); ++k)
            if (pieces[parents[k]] > 1)
                times_[k] = 0;
        inherit(solution_, parents);
        return true;
    }

  private:
    void measure(std::span<const std::uint32_t> some, unsigned most_rows, std::uint64_t seed) {
        const LightWithinPatches found = light_within_patches(
            {mesh_, tracer_, solution_}, some,
            {.estimates = 1, .most_rows = most_rows, .seed = seed}, workers_, monitor_.interrupted);
        for (std::size_t k = 0; k < some.size(); ++k) {
            fresh_ += found.square[k];
            fresh_squares_ += found.square[k] * found.square[k];
            double& times = times_[some[k]];
            double& square = square_[some[k]];
            square = (times * square + most_rows * found.square[k]) / (times + most_rows);
            times += most_rows;
        }
        rays_ += found.rays;
    }
    [[nodiscard]] double size() const { return reflected_square(mesh_, solution_); }

    Mesh& mesh_;
    const Tracer& tracer_;
    Solution& solution_;
    const AdaptiveDivision& options_;
    Monitor& monitor_;
    Workers workers_;
    std::vector<double> square_; ///< by patch, as of light_within_patches()
    std::vector<double> times_;  ///< that the patch was measured, by rows of points
    double fresh_ = 0;           ///< sum of what was measured in this round alone
    double fresh_squares_ = 0;   ///< and of its squares
    std::size_t solved_;
    std::uint64_t rays_ = 0;
};

} // namespace

StopRule rough_stop(const AdaptiveDivision& options, std::size_t patches) {
    constexpr std::uint64_t rays_of_patch = 4096, least_rays = 4'000'000;
    return {.steps = {},
            .seconds = {},
            .error = std::clamp(options.error, least_rough_error, most_rough_error),
            .rays = least_rays + rays_of_patch * patches};
}

Solution rough_solution(const Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                        Monitor& monitor) {
    const Needs needs = find_needs(mesh);
    SolveOptions solve;
    solve.seed = options.seed;
    solve.threads = options.threads;
    const StopRule stop = rough_stop(options, mesh.patches().size());
    solve.aim = stop.error.value_or(0);
    solve.memory = options.memory;
    const auto solver = find_method("gathering")->make({mesh, tracer, solve, monitor, needs});
    run(*solver, {mesh, tracer, solve, monitor, needs}, stop);
    return solver->solution();
}

bool divide_where_light_changes(Mesh& mesh, const Tracer& tracer, Solution& solution,
                                const AdaptiveDivision& options, Monitor& monitor,
                                const std::function<void(const DivisionRound&)>& after_round) {
    if (solution.steps == 0 || !(reflected_square(mesh, solution) > 0))
        return false;
    const std::size_t patches = mesh.patches().size();
    Division division(mesh, tracer, solution, options, monitor);
    for (unsigned round = 0; round < most_rounds; ++round) {
        if (!division.solve_if_due() || monitor.interrupted)
            break;
        division.measure(hash_words({options.seed, 2, round}));
        if (monitor.interrupted)
            break;
        const DivisionRound found = division.round();
        if (after_round)
            after_round(found);
        if (division.is_done() || !division.divide())
            break;
    }
    return mesh.patches().size() > patches;
}

} // namespace hemilux
