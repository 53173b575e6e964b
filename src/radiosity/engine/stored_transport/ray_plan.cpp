#include "radiosity/engine/stored_transport/ray_plan.h"

#include "geometry/elementary.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/stored_transport/ray_allocation.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace hemilux {
namespace {

/// The rays per patch at which the run ends, whatever the error.
constexpr double max_rays = 1u << 20;

/// The most rays of a step towards an error, over those before: more at once would trust the first
/// few rays too much.
constexpr double max_growth = 4;

/// The part of an error asked for that a step is to reach, so that the run seldom takes one more.
constexpr double aim_below = .97;

/// The least rays of a step towards an error, over those before; and the factor from one number to
/// the next that is tried.
constexpr double min_step = 1.1, try_next = 1.04;

/// The power of the rays with which the variance falls from the second step on. The first few rays
/// of a patch are spread best, and from one step to two it falls with `variance_fall`.
constexpr double later_variance_fall = 1.25;

/// The share of the mean of shadow rays that a patch gets which no light has reached. It gets few,
/// but not none, as an emitter may shine through a gap that all of them have missed.
constexpr double share_of_unlit = 1.0 / 8;

/// The least mean of a first step with a target, of one batch: the search for what light can reach
/// takes a ray of each patch.
constexpr double min_first = 1.5;

/// With a target, the first step has so many times as many rays as patches of the target would get
/// if all were the target. More waste rays before it is known where they count. Fewer take one more
/// step, and each step solves for all patches however few its rays are.
constexpr double times_in_first = 4;

/// A first step with a target has at most so large a part of the rays of one without. The others
/// wait until it is known where they count. Where the target is nearly all of the scene, there is
/// less to wait for.
constexpr double max_of_first = 1.0 / 3;

/// With a target, each of the two kinds gets at least this part of the rays that are added. How
/// much of the error comes from which kind is known of the target's own rays, and less of others'.
constexpr double min_of_kind = 1.0 / 4;

/// Throws StateError for rays that cannot have been allocated with this mean (ray_allocation.h). A
/// patch has at most sqrt(2) times `max_share_of_rays` of what is expected for it, and all have
/// more than a small part of the mean.
void check_allocated(std::span<const std::uint32_t> rays, double mean, double max_expected) {
    constexpr double min_share = 1.0 / 64;
    const double max_share = 1.5 * max_share_of_rays * max_expected;
    double sum = 0, count = 0;
    for (const std::uint32_t of_patch : rays) {
        if (of_patch > std::max(1.0, max_share * mean))
            throw StateError("a patch has more rays than were planned");
        sum += of_patch;
        count += of_patch > 0;
    }
    if (count > 0 && sum < min_share * mean * count)
        throw StateError("the patches have fewer rays than were planned");
}

} // namespace

RayPlan::RayPlan(const Mesh& mesh, const Needs& needs, double random, double to_emitters,
                 const RayGoal& goal)
    : weights_(mesh, needs), goal_(goal) {
    first_.random = std::clamp(random, 1.0, max_rays);
    first_.to_emitters = to_emitters > 0 ? first_.random : 0;
    now_.rays.random.resize(mesh.patches().size());
    now_.rays.to_emitters.resize(mesh.patches().size());
    before_ = now_;
}

void RayPlan::begin() {
    for (std::size_t i = 0; i < now_.rays.random.size(); ++i) {
        now_.rays.random[i] = weights_.random()[i] > 0 ? 1 : 0;
        now_.rays.to_emitters[i] = first_.to_emitters > 0 && weights_.to_emitters()[i] > 0 ? 1 : 0;
    }
}

void RayPlan::aim(std::span<const double> importance) {
    aim_.clear();
    for (const double each : importance) // as variances in weigh_emitters()
        aim_.push_back(elementary::pow(each, 1 / (1 + variance_fall)));
}

/// Returns what is expected for each patch, over the mean of those that are to get more: as much as
/// it is important. A patch of little importance counts as the mean all the same. What many such
/// patches send together is known by few rays each, but not by any number.
std::vector<double> RayPlan::expected_rays(std::span<const double> weights) const {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < aim_.size(); ++i)
        if (weights[i] * aim_[i] > 0) {
            sum += aim_[i];
            ++count;
        }
    std::vector<double> expected;
    for (const double each : aim_)
        expected.push_back(sum > 0 ? std::max(each * count / sum, 1.0) : 1);
    return expected;
}

std::vector<std::uint32_t> RayPlan::allocate(std::span<const double> weights, double mean,
                                             std::span<const std::uint32_t> already) const {
    if (!has_target())
        return allocate_rays(weights, mean, already);
    std::vector<double> aimed;
    for (std::size_t i = 0; i < weights.size(); ++i)
        aimed.push_back(weights[i] * aim_[i]);
    return allocate_rays(aimed, mean, already, expected_rays(weights));
}

/// Returns the mean of one kind in the first step; it is less than without a target.
double RayPlan::first_mean(double mean) const {
    if (!has_target() || !goal_.growing)
        return mean;
    const double sum = std::accumulate(aim_.begin(), aim_.end(), 0.0);
    const double least = std::min(min_first, mean);
    const double share = std::min(sum / double(aim_.size()), 1.0);
    return std::clamp(times_in_first * share * mean, least,
                      std::max(std::max(max_of_first, share) * mean, least));
}

/// Returns the rays of a plan, of one batch.
double sum_of(const PlannedRays& rays) {
    double sum = 0;
    for (const auto* kind : {&rays.random, &rays.to_emitters})
        for (const std::uint32_t each : *kind)
            sum += each;
    return sum;
}

void RayPlan::grow(const ErrorSoFar& known, double room, double max_rays, const Workers& workers) {
    before_ = now_;
    if (has_begun()) {
        choose(known);
        now_.random = std::min(now_.random, room * before_.random);
    } else {
        now_.random = first_mean(first_.random);
        now_.to_emitters = first_mean(first_.to_emitters);
    }
    do
        allocate_all(workers);
    while (sum_of(now_.rays) > max_rays && shrink());
}

bool RayPlan::shrink() {
    constexpr double left = .8, least = 1.0 / 64;
    const double random = now_.random - std::max(before_.random, 1.0);
    const double to_emitters =
        now_.to_emitters - std::max(before_.to_emitters, std::min(now_.to_emitters, 1.0));
    now_.random -= (1 - left) * random;
    now_.to_emitters -= (1 - left) * to_emitters;
    return random + to_emitters > least;
}

void RayPlan::allocate_all(const Workers& workers) {
    workers.for_chunks(2, 1, [&](std::size_t kind, std::size_t) {
        if (kind == 0)
            now_.rays.random = allocate(weights_.random(), now_.random, before_.rays.random);
        else
            now_.rays.to_emitters =
                allocate(weights_.to_emitters(), now_.to_emitters, before_.rays.to_emitters);
    });
    const auto of_unlit =
        std::bit_floor(static_cast<std::uint32_t>(share_of_unlit * now_.to_emitters));
    for (std::size_t i = 0; i < now_.rays.to_emitters.size(); ++i)
        if (weights_.is_left_out(i) && (!has_target() || aim_[i] > 0))
            now_.rays.to_emitters[i] = std::max(of_unlit, before_.rays.to_emitters[i]);
}

void RayPlan::choose(const ErrorSoFar& known) {
    const double rays = before_.random + before_.to_emitters;
    if (!known.drained)
        return split(2 * rays, known);
    if (!goal_.growing)
        return split(rays + first_.random + first_.to_emitters, known);
    if (!(goal_.aim > 0))
        return split(2 * rays, known);
    double factor = min_step;
    do
        split(factor * rays, known);
    while (!(predicted(known) <= aim_below * goal_.aim) && (factor *= try_next) <= max_growth);
}

/// Splits so many rays in all between the two kinds so that the error is least. Variances are taken
/// to fall with the power `variance_fall` of the rays. No ray is taken back.
void RayPlan::split(double rays, const ErrorSoFar& known) {
    now_.random = rays;
    if (!(before_.to_emitters > 0))
        return;
    const auto due = [](double variance, double rays_before) {
        return elementary::pow(variance * elementary::pow(rays_before, variance_fall),
                               1 / (1 + variance_fall));
    };
    const double random =
        due(std::max(known.variance - known.variance_from_emitters, 0.0), before_.random);
    const double to_emitters = due(known.variance_from_emitters, before_.to_emitters);
    const double share = random + to_emitters > 0 ? random / (random + to_emitters) : .5;
    const double added = rays - before_.random - before_.to_emitters;
    const double least = has_target() ? min_of_kind * added : 0;
    now_.random =
        std::clamp(share * rays, before_.random + least, rays - before_.to_emitters - least);
    now_.to_emitters = std::max(rays - now_.random, before_.to_emitters); // may be rounded below it
}

/// Returns the error that the planned rays will probably leave.
double RayPlan::predicted(const ErrorSoFar& known) const {
    const double of_emitters =
        known.variance > 0 ? std::min(known.variance_from_emitters / known.variance, 1.0) : 0;
    const double fall = before_.random > first_.random ? later_variance_fall : variance_fall;
    double left = (1 - of_emitters) * elementary::pow(before_.random / now_.random, fall);
    if (now_.to_emitters > 0)
        left += of_emitters * elementary::pow(before_.to_emitters / now_.to_emitters, fall);
    return known.relative * std::sqrt(left);
}

bool RayPlan::at_most() const { return std::max(now_.random, now_.to_emitters) >= max_rays; }

/// Saves what was planned, and what is known of the patches; the rest follows from the scene.
void RayPlan::save(StateWriter& state) const {
    for (const RayBudget* stage : {&before_, &now_}) {
        state.add(stage->random);
        state.add(stage->to_emitters);
        state.add(std::span<const std::uint32_t>(stage->rays.random));
        state.add(std::span<const std::uint32_t>(stage->rays.to_emitters));
    }
    weights_.save(state);
}

void RayPlan::load(StateReader& state) {
    for (RayBudget* stage : {&before_, &now_}) {
        for (double* mean : {&stage->random, &stage->to_emitters})
            state.get(*mean, {0, max_growth * max_rays});
        stage->rays.random.resize(weights_.random().size());
        stage->rays.to_emitters.resize(weights_.random().size());
        state.get(std::span(stage->rays.random));
        state.get(std::span(stage->rays.to_emitters));
        const double max_expected = has_target() ? double(aim_.size()) : 1;
        check_allocated(stage->rays.random, stage->random, max_expected);
        check_allocated(stage->rays.to_emitters, stage->to_emitters, max_expected);
    }
    if (before_.random > now_.random || before_.to_emitters > now_.to_emitters)
        throw StateError("the plan of rays does not grow");
    weights_.load(state);
}

} // namespace hemilux
