#include "radiosity/research/targets/rays_to_balls.h"

#include "parallel/workers.h"
#include "radiosity/engine/rays/receivers.h"
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

/// Makes the numbers of rays whole on a line, as Bounces does (bounces_plan.cpp).
void RaysToBalls::shoot(const SolverInput& input, const BouncePower& bounce,
                        std::uint64_t of_bounce, const Workers& workers,
                        FunctionRef<void(const SeparateShots&)> collect) const {
    const std::uint64_t stream = hash_words({of_bounce, stream_of_balls});
    std::vector<double> before{Rng(stream).uniform()}; // by sender and ball
    for (const std::uint32_t i : bounce.senders)
        for (std::size_t k = 0; k < balls.count(); ++k)
            before.push_back(before.back() + mean_of_channels(bounce.unshot[i]) / bounce.ray_power *
                                                 balls.times(i, k));
    const double end = whole_below(before.back());
    const auto count = static_cast<std::size_t>(std::ceil(end / rays_per_batch));
    std::vector<SeparateShots> batches(count);
    workers.for_each_in_order(
        count,
        [&](std::size_t b) {
            const double from = static_cast<double>(b) * rays_per_batch;
            shoot(input, bounce, before, from, std::min(from + rays_per_batch, end), stream,
                  batches[b]);
        },
        [&](std::size_t b) {
            collect(batches[b]);
            batches[b] = {};
        });
}

/// Shoots the rays of the line in (from, to].
void RaysToBalls::shoot(const SolverInput& input, const BouncePower& bounce,
                        std::span<const double> rays_before, double from, double to,
                        std::uint64_t stream, SeparateShots& shots) const {
    std::optional<PatchStart> start; // of the last ray
    std::size_t end = 1;             // where the interval that holds the ray ends
    if (!input.monitor.interrupted)
        end = static_cast<std::size_t>(std::ranges::lower_bound(rays_before, from + 1) -
                                       rays_before.begin());
    for (double ray = from + 1; ray <= to && !input.monitor.interrupted; ++ray) {
        while (rays_before[end] < ray)
            ++end;
        const std::uint32_t patch = bounce.senders[(end - 1) / balls.count()];
        const std::size_t ball = (end - 1) % balls.count();
        const double before = whole_below(rays_before[end - 1]);
        const double here = whole_below(rays_before[end]) - before;
        const double expected = rays_before[end] - rays_before[end - 1];
        if (!start || start->patch != patch)
            start.emplace(input.mesh, patch);
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
    find_receivers(shots.rays, input.mesh, input.tracer, shots.receivers);
    input.monitor.rays += shots.rays.size();
}

} // namespace hemilux
