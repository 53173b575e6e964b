#include "radiosity/light/division/adaptive_division.h"

#include "radiosity/engine/cells/refine.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/stored_transport/stored_transport_method.h"
#include "radiosity/light/division/division_weights.h"
#include "radiosity/light/division/inherited.h"
#include "radiosity/light/division/patch_levels.h"
#include "radiosity/light/final_gather/light_within_patches.h"
#include "radiosity/light/final_gather/linear_light.h"
#include "radiosity/light/light_error/division_error.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace hemilux {
namespace {

/// The numbers that were tuned by runs over many scenes: what each buys, and what it costs.
namespace tuned {

// Rounds of measuring and cutting.

/// The rounds of a division at most [-]. They only end what does not converge.
constexpr unsigned max_rounds = 20;
/// How many times as many patches a round makes, at most and at least [-]. Less growth wastes fewer
/// patches, as what varies is only known roughly; more takes fewer rounds. A round costs as much as
/// the patches that it would spare if it made fewer than the least.
constexpr double max_growth = 4, min_growth = 1.1;
/// The number of patches that a round may add whatever the growth: it spares small scenes rounds.
constexpr std::size_t min_room = 256;

// Points where the light is measured.

/// The rows of points on a large patch, when it is new and in further rounds [-]. Points grow with
/// their square; more find what is small.
constexpr unsigned rows_at_first = 6, rows_again = 3;
/// One in so many of the other patches is measured again in each round [-]. Fewer save rays; more
/// make the estimate of what is left surer.
constexpr std::uint64_t one_again_in = 4;
/// The rays of a point, times the error that is asked for [-], and their limits. Noise that is
/// large beside what is allowed would divide patches for nothing; rays cost time.
constexpr double rays_at_error_of_one = 0.11, min_rays = 4, max_rays = 16;
/// Patches that hold very little light are not measured. If it varied by as much as it is, all that
/// they leave would be this share of what is allowed [-]. More saves points and risks that error.
constexpr double negligible_share = 0.05;
/// The small ones of more patches than this are tried by a sample before each is measured. Where
/// they hardly vary they are not: what they leave is at most this share of what is allowed [-].
constexpr std::size_t surely_measured = 16'384;
constexpr double even_share = 0.1;
/// A division is done when so many standard errors above what was measured are allowed [-]: few
/// points may miss what few patches hold. More is surer and takes more patches.
constexpr double sure_by = 0.5;

// Rough solutions, which say where the light is.

/// The light is solved anew when there are so many times more patches than were solved [-]. Less
/// follows fine shadows sooner, for a solution each time.
constexpr double solved_at_growth = 6;
/// The limits on a rough solution's relative error [-]: most of it is gone once the light is
/// reflected, and a smaller one takes more rays.
constexpr double min_rough_error = 0.02, max_rough_error = 0.05;
/// The rays after which a rough solution ends whatever its error, in all and for each patch [rays].
constexpr std::uint64_t rough_rays = 4'000'000, rough_rays_of_patch = 4096;

// Slopes of the light on the patches that remain.

/// The share of the allowed squared error that the noise of slopes may be [-]. Less noise takes
/// more rays.
constexpr double share_of_noise = 0.2;
/// The rounds of rays for less of it [-].
constexpr double max_rounds_of_slopes = 8;

} // namespace tuned

unsigned rays_of_estimate(double error) {
    return static_cast<unsigned>(std::clamp(std::round(tuned::rays_at_error_of_one / error),
                                            tuned::min_rays, tuned::max_rays));
}

} // namespace

StopRule rough_stop(const AdaptiveDivision& options, std::size_t patches) {
    return {.steps = {},
            .seconds = {},
            .error = std::clamp(options.error, tuned::min_rough_error, tuned::max_rough_error),
            .rays = std::min<std::uint64_t>(
                tuned::rough_rays + tuned::rough_rays_of_patch * patches, options.max_rays)};
}

Solution rough_solution(const Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                        Monitor& monitor, std::span<const double> target) {
    const Needs needs = options.keep_all ? everything_needed : find_needs(mesh);
    SolveOptions solve;
    solve.seed = options.seed;
    solve.threads = options.threads;
    const StopRule stop = rough_stop(options, mesh.patches().size());
    solve.stop = stop;
    solve.memory = options.memory;
    solve.keep_all = options.keep_all;
    const SolverInput input{mesh, tracer, solve, monitor, needs, target};
    const auto solver = stored_transport_method.make(input);
    run(*solver, input, stop);
    return solver->solution();
}

Division::Division(Mesh& mesh, const Tracer& tracer, const AdaptiveDivision& options,
                   Monitor& monitor)
    : mesh_(mesh), tracer_(tracer), options_(options), monitor_(monitor), workers_(options.threads),
      solved_(mesh.patches().size()), square_(solved_), times_(solved_), slopes_(solved_),
      is_due_(solved_, 1), measured_at_(solved_) {}

bool Division::divide(Solution& light, double error,
                      const std::function<void(const DivisionRound&)>& after_round) {
    const std::size_t patches = mesh_.patches().size();
    for (unsigned round = 0; round < tuned::max_rounds && light.steps > 0; ++round) {
        spent_ += std::exchange(rays_, 0);
        if (spent_ >= options_.max_rays)
            break;
        if (!solve_if_due(light))
            break;
        const double size = reflected_square(mesh_, light), goal = error * error * size;
        if (!(size > 0) || monitor_.interrupted)
            break;
        monitor_.phase = "dividing";
        ++round_;
        weigh(light);
        measure(light, goal);
        if (monitor_.interrupted)
            break;
        if (after_round)
            after_round({mesh_.patches().size(), std::sqrt(std::max(fresh_, 0.0) / size), rays_});
        if (is_done(goal) || !cut(light, goal))
            break;
    }
    return mesh_.patches().size() > patches;
}

/// Solves the light anew if that is due. Returns false if no solution was found.
bool Division::solve_if_due(Solution& light) {
    const std::size_t patches = mesh_.patches().size();
    if (double(patches) < tuned::solved_at_growth * double(solved_))
        return true;
    AdaptiveDivision options = options_;
    options.max_rays -= spent_;
    Solution solution = rough_solution(mesh_, tracer_, options, monitor_, light.weight);
    if (solution.steps == 0)
        return false;
    rays_ += solution.rays_energy;
    light = std::move(solution);
    solved_ = patches;
    return true;
}

/// Finds the weights of patches for a target: what lights it counts too.
void Division::weigh(const Solution& light) {
    if (!light.weight.empty())
        weight_ = division_weights(mesh_, tracer_, light.weight,
                                   hash_words({options_.seed, 7, measured_}), workers_);
}

void Division::measure(const Solution& light, double goal) {
    const auto most = [&](std::uint32_t i) {
        const Vec3 reflected = light.radiosity[i] - mesh_.material(i).emission;
        const double all = mesh_.patches()[i].area * glm::dot(reflected, reflected);
        return counts(i) * std::max(all, square_[i]); // inherited
    };
    std::vector<std::uint32_t> due;
    for (std::uint32_t i = 0; i < is_due_.size(); ++i)
        if (is_due_[i])
            due.push_back(i);
    std::ranges::sort(due, {}, [&](std::uint32_t i) { return std::pair(most(i), i); });
    double left_out = 0;
    const auto first = std::ranges::find_if(due, [&](std::uint32_t i) {
        return (left_out += most(i)) > tuned::negligible_share * goal;
    });
    due.erase(due.begin(), first);
    std::erase_if(due, [&](std::uint32_t i) { return !(counts(i) > 0); });
    fresh_ = fresh_squares_ = 0;
    if (due.size() > tuned::surely_measured) {
        const auto small = std::span(due).first(due.size() - tuned::surely_measured);
        std::vector<double> held;
        for (const std::uint32_t i : small)
            held.push_back(most(i));
        if (are_even(light, small, held, tuned::even_share * goal)) {
            for (const std::uint32_t i : small)
                is_due_[i] = 0;
            due.erase(due.begin(), due.begin() + std::ssize(small));
        }
    }
    std::ranges::sort(due);
    const auto known = std::stable_partition(due.begin(), due.end(),
                                             [&](std::uint32_t i) { return times_[i] == 0; });
    measure(light, {due.begin(), known}, 1, tuned::rows_at_first);
    measure(light, {known, due.end()}, 1, tuned::rows_again);
    // Patches that were chosen for what was measured there are not a fair sample of all; these are.
    std::vector<std::uint32_t> some;
    for (std::uint32_t i = 0; i < is_due_.size(); ++i)
        if (counts(i) > 0 && times_[i] > 0 && measured_at_[i] < round_ &&
            hash_words({options_.seed, measured_, i}) % tuned::one_again_in == 0)
            some.push_back(i);
    measure(light, some, 1, tuned::rows_again, tuned::one_again_in);
}

/// Tries patches that hold so much light each by a random sample, and returns whether all together
/// vary by less than is `allowed` if each has one light all over. The sample is drawn by what they
/// hold, and is so large that what none of it shows is surely less (the rule of three).
bool Division::are_even(const Solution& light, std::span<const std::uint32_t> patches,
                        std::span<const double> held, double allowed) {
    constexpr double min_gain = 4, sigmas = 2;
    const double all = std::reduce(held.begin(), held.end()), size = rule_of_three * all / allowed;
    if (!(min_gain * size < double(patches.size())))
        return false;
    const double step = all / std::ceil(size);
    std::vector<std::uint32_t> some;
    std::vector<double> stands_for;
    double sum = 0, next = step * Rng(hash_words({options_.seed, 8, measured_})).uniform();
    for (std::size_t k = 0; k < patches.size(); ++k) {
        sum += held[k];
        double times = 0;
        for (; next < sum; next += step)
            ++times;
        if (times > 0) {
            some.push_back(patches[k]);
            stands_for.push_back(times * step / held[k]);
        }
    }
    const LightWithinPatches found = within(light, some, 1, tuned::rows_again);
    double square = 0, squares = 0;
    for (std::size_t k = 0; k < some.size(); ++k) {
        const Patch& patch = mesh_.patches()[some[k]];
        const Slope slope = agreed_slope(patch, found.slopes[k]).slope;
        const double own = stands_for[k] * counts(some[k]) *
                           (found.square[k] + patch.area * variance_of(patch, slope));
        square += own;
        squares += own * own;
    }
    if (!(square + sigmas * std::sqrt(squares) <= allowed) || monitor_.interrupted)
        return false;
    fresh_ += square;
    fresh_squares_ += squares;
    return true;
}

/// Gathers at new points each time.
LightWithinPatches Division::within(const Solution& light, std::span<const std::uint32_t> some,
                                    unsigned rounds, unsigned max_rows) {
    LightWithinPatches found =
        light_within_patches({mesh_, tracer_, light}, some,
                             {.rounds = rounds,
                              .rays = rays_of_estimate(options_.error),
                              .max_rows = max_rows,
                              .seed = hash_words({options_.seed, 2, measured_++})},
                             workers_, monitor_.interrupted);
    rays_ += found.rays;
    return found;
}

/// Measures some patches. Each stands for so many in what was found of all.
void Division::measure(const Solution& light, std::span<const std::uint32_t> some, unsigned rounds,
                       unsigned max_rows, double stand_for) {
    const LightWithinPatches found = within(light, some, rounds, max_rows);
    if (monitor_.interrupted)
        return;
    for (std::size_t k = 0; k < some.size(); ++k) {
        const std::uint32_t i = some[k];
        const double square = counts(i) * found.square[k];
        fresh_ += stand_for * square;
        fresh_squares_ += stand_for * square * square;
        const double more = double(rounds), of_new = more / (times_[i] + more);
        square_[i] = std::lerp(square_[i], found.square[k], of_new);
        for (std::size_t e = 0; e < 2; ++e) {
            Slope& slope = slopes_[i][e];
            slope.x = glm::mix(slope.x, found.slopes[k][e].x, of_new);
            slope.y = glm::mix(slope.y, found.slopes[k][e].y, of_new);
        }
        times_[i] += more;
        measured_at_[i] = round_;
        is_due_[i] = 0;
    }
}

/// Returns whether the division is done, and that is known from how the squares scatter.
bool Division::is_done(double goal) const {
    return fresh_ + tuned::sure_by * std::sqrt(fresh_squares_) <= goal;
}

/// Divides patches. Returns false if nothing can be divided.
bool Division::cut(Solution& light, double goal) {
    const std::size_t before = mesh_.patches().size();
    const auto times = [&](double growth) {
        return static_cast<std::size_t>(growth * double(before));
    };
    std::vector<double> that_count;
    for (std::size_t i = 0; i < before; ++i)
        that_count.push_back(counts(i) * square_[i]);
    const std::vector<std::uint8_t> levels = levels_of_division(
        that_count,
        {.goal = goal,
         .min_pieces = times(tuned::min_growth),
         .max_pieces = std::min(options_.max_patches, times(tuned::max_growth) + tuned::min_room)});
    if (std::ranges::none_of(levels, [](std::uint8_t level) { return level > 0; }))
        return false;
    std::vector<Vec3> emission; // of a texture, which differs from piece to piece
    for (std::uint32_t i = 0; i < before; ++i)
        emission.push_back(mesh_.material(i).emission);
    const std::vector<std::uint32_t> parents = refine(mesh_, levels);
    square_ = inherited(square_, parents);
    slopes_ = inherited(slopes_, parents);
    times_ = inherited(times_, parents);
    is_due_ = inherited(is_due_, parents);
    measured_at_ = inherited(measured_at_, parents);
    std::vector<std::uint32_t> pieces(before);
    for (const std::uint32_t parent : parents)
        ++pieces[parent];
    for (std::size_t k = 0; k < parents.size(); ++k)
        if (pieces[parents[k]] > 1) {
            times_[k] = 0;
            square_[k] /= pieces[parents[k]];
            is_due_[k] = 1;
        }
    inherit(light, parents);
    for (std::uint32_t k = 0; k < parents.size(); ++k)
        light.radiosity[k] += mesh_.material(k).emission - emission[parents[k]];
    return true;
}

std::uint64_t Division::add_slopes(Solution& light, double error) {
    spent_ += std::exchange(rays_, 0);
    weigh(light);
    const auto patches = mesh_.patches();
    const double allowed = tuned::share_of_noise * error * error * reflected_square(mesh_, light);
    double noise = 0;
    std::vector<std::uint32_t> noisy;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        const double own = counts(i) * agreed_slope(patches[i], slopes_[i]).noise;
        noise += own;
        if (own * double(patches.size()) > allowed)
            noisy.push_back(i);
    }
    if (noise > allowed && !monitor_.interrupted) {
        const auto rounds = static_cast<unsigned>(
            std::min(std::round(noise / allowed), tuned::max_rounds_of_slopes));
        measure(light, noisy, rounds, tuned::rows_again);
    }
    light.slope = slopes();
    return rays_;
}

std::vector<Slope> Division::slopes() const {
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < slopes_.size(); ++i)
        slopes.push_back(agreed_slope(mesh_.patches()[i], slopes_[i]).slope);
    return slopes;
}

void Division::doubt() { is_due_.assign(is_due_.size(), 1); }

} // namespace hemilux
