// The part of a bounce that goes straight to the balls of a target (target_balls.h).

#include "radiosity/engine/shooting/bounces.h"
#include "radiosity/engine/shooting/systematic_cells.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hemilux {
namespace {

/// The stream of the rays to balls, hashed with that of the bounce.
constexpr std::uint64_t stream_of_balls = 0xba11;
constexpr double rays_per_batch = 4096;

} // namespace

/// Shoots the rays to balls. Their numbers are made whole on a line, as in plan().
void Bounces::shoot_to_balls(const Workers& workers, std::uint64_t of_bounce, StepResult& result) {
    const std::uint64_t stream = hash_words({of_bounce, stream_of_balls});
    const TargetBalls& balls = *task_->balls;
    std::vector<double> before{Rng(stream).uniform()}; // by sender and ball
    for (const std::uint32_t i : senders_)
        for (std::size_t k = 0; k < balls.count(); ++k)
            before.push_back(before.back() +
                             mean_of_channels(unshot_[i]) / task_->ray_power * balls.times(i, k));
    const double end = whole_below(before.back());
    const auto count = static_cast<std::size_t>(std::ceil(end / rays_per_batch));
    std::vector<BallShots> batches(count);
    workers.for_each_in_order(
        count,
        [&](std::size_t b) {
            const double from = static_cast<double>(b) * rays_per_batch;
            shoot_to_balls(before, from, std::min(from + rays_per_batch, end), stream, batches[b]);
        },
        [&](std::size_t b) {
            collect(batches[b], result);
            batches[b] = {};
        });
}

/// Shoots the rays of the line in (from, to].
void Bounces::shoot_to_balls(std::span<const double> rays_before, double from, double to,
                             std::uint64_t stream, BallShots& shots) const {
    const TargetBalls& balls = *task_->balls;
    std::optional<PatchStart> start; // of the last ray
    std::size_t end = 1;             // where the interval that holds the ray ends
    if (!input_.monitor.interrupted)
        end = static_cast<std::size_t>(std::ranges::lower_bound(rays_before, from + 1) -
                                       rays_before.begin());
    for (double ray = from + 1; ray <= to && !input_.monitor.interrupted; ++ray) {
        while (rays_before[end] < ray)
            ++end;
        const std::uint32_t patch = senders_[(end - 1) / balls.count()];
        const std::size_t ball = (end - 1) % balls.count();
        const double before = whole_below(rays_before[end - 1]);
        const double here = whole_below(rays_before[end]) - before;
        const double expected = rays_before[end] - rays_before[end - 1];
        if (!start || start->patch != patch)
            start.emplace(input_.mesh, patch);
        const auto shot =
            balls.draw(*start, ball,
                       hash_words({stream, patch, ball, static_cast<std::uint64_t>(ray - before)}));
        if (!shot)
            continue;
        const unsigned takers = balls.takers(patch, shot->ray.origin, shot->ray.direction);
        shots.rays.push_back(shot->ray);
        shots.senders.push_back(patch);
        shots.power.push_back(shot->power / std::max(takers, 1u) /
                              (expected >= 1 ? here : expected));
    }
    find_receivers(shots.rays, input_.mesh, input_.tracer, shots.receivers);
    input_.monitor.rays += shots.rays.size();
}

void Bounces::collect(const BallShots& shots, StepResult& result) {
    if (input_.monitor.interrupted) // the batch may not be whole
        return;
    for (std::size_t k = 0; k < shots.rays.size(); ++k) {
        const Vec3 power = shots.power[k] * unshot_[shots.senders[k]];
        Lost lost;
        receive(power, std::span(shots.receivers).subspan(k, 1), lost);
        result.sent += power;
        if (lost.escaped > 0)
            result.escaped += power;
        if (lost.absorbed > 0)
            result.absorbed += power;
    }
    result.rays += shots.rays.size();
}

} // namespace hemilux
