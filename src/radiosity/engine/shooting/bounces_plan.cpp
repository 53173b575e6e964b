// This file decides which rays a bounce shoots: how many each sender has, and which of them a
// thread takes at a time.

#include "radiosity/engine/shooting/bounces.h"
#include "radiosity/engine/shooting/systematic_cells.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// The rays that one thread takes at a time: a part of those left in the bounce, so that no thread
/// waits long for another at its end.
constexpr double items_of_rest = 32, min_item = 256, largest_item = 8192;
constexpr std::uint32_t patches_per_item = 32;
/// The number of work items listed at a time; a step of 1e9 rays per patch has millions.
constexpr std::size_t max_items = 4096;

/// Returns the number of a ray among those of its patch. After 2^32 rays of one patch, numbers
/// begin anew.
std::uint32_t ray_number(double rays_before) {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(rays_before));
}

} // namespace

/// Allocates rays in proportion to the power to be shot, times the hook's factor. Sender k owns
/// the interval from rays_before_[k] to rays_before_[k+1] of a line on which a ray stands at each
/// whole number. As the line's origin is random, each patch and each cell gets its expected number
/// on average, rounded up or down.
void Bounces::plan(std::uint64_t stream) {
    rays_before_.resize(senders_.size() + 1);
    rays_before_[0] = Rng(stream).uniform();
    for (std::size_t k = 0; k < senders_.size(); ++k) {
        const std::uint32_t i = senders_[k];
        const double rays =
            rays_by_power() ? task_->rays(i, unshot_[i]) * (hook_ ? hook_->rays_for_power(i) : 1)
                            : input_.options.rays;
        rays_before_[k + 1] = rays_before_[k] + rays;
    }
}

/// Cuts by numbers of rays, as an emitter may shoot half of a bounce. Work items do not depend on
/// the number of threads.
bool Bounces::cut(Place& next) {
    items_.clear();
    if (rays_by_power())
        cut_line(next);
    else
        cut_same_number(next);
    return !items_.empty();
}

void Bounces::cut_line(Place& next) {
    const double end = whole_below(rays_before_.back());
    const auto sender_of = [&](double ray) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(rays_before_, ray) -
                                          rays_before_.begin() - 1);
    };
    for (double& from = next.ray; from < end && items_.size() < max_items;) {
        const double size =
            std::clamp(std::ceil((end - from) / items_of_rest), min_item, largest_item);
        const double to = std::min(from + size, end);
        items_.push_back({sender_of(from + 1), sender_of(to) + 1, from, to});
        from = to;
    }
}

/// Rays do not stand on the line here: each sender has the same number, counted from 0. If a sender
/// has many, an item is a part of them.
void Bounces::cut_same_number(Place& next) {
    const auto senders = static_cast<std::uint32_t>(senders_.size());
    const bool whole = input_.options.rays <= largest_item;
    while (next.sender < senders && items_.size() < max_items) {
        const std::uint32_t last = std::min(next.sender + (whole ? patches_per_item : 1), senders);
        const double end = std::numeric_limits<double>::infinity();
        const bool is_last = whole || next.ray + largest_item >= input_.options.rays;
        items_.push_back({next.sender, last, next.ray, is_last ? end : next.ray + largest_item});
        next = is_last ? Place{last, 0} : Place{next.sender, next.ray + largest_item};
    }
}

void Bounces::schedule(const WorkItem& item, std::vector<RayGroup>& groups) const {
    thread_local AllocatedCells memory;
    const auto allocate = [&](std::size_t k) {
        return tools_.strategy->allocate(senders_[k], memory);
    };
    if (!rays_by_power()) {
        for (std::size_t k = item.first; k < item.last; ++k)
            schedule_same_number(senders_[k], item, allocate(k), groups);
        return;
    }
    double last = whole_below(rays_before_[item.first]);
    for (std::size_t k = item.first; k < item.last; ++k) {
        const double first = std::exchange(last, whole_below(rays_before_[k + 1]));
        if (std::min(last, item.to) > std::max(first, item.from))
            schedule(k, item, allocate(k), groups);
    }
}

void Bounces::schedule(std::size_t sender, const WorkItem& item, const Allocation& allocation,
                       std::vector<RayGroup>& groups) const {
    const std::uint32_t patch = senders_[sender];
    const SystematicCells line(allocation, rays_before_[sender], rays_before_[sender + 1]);
    const auto before = static_cast<std::int64_t>(rays_before_[sender]),
               from = static_cast<std::int64_t>(item.from), to = static_cast<std::int64_t>(item.to);
    line.for_each_cell(
        [&](std::uint16_t cell, double expected, std::int64_t low, std::int64_t high) {
            const std::int64_t first = std::max(low, from), here = std::min(high, to) - first;
            // Below one ray per cell, the ray that is shot carries the power of those that are not.
            const double sharing = expected >= 1 ? static_cast<double>(high - low) : expected;
            if (here > 0)
                groups.push_back({patch, cell, static_cast<std::uint32_t>(low - before),
                                  static_cast<std::uint32_t>(first - before),
                                  static_cast<std::uint32_t>(here), 1 / sharing});
        });
}

void Bounces::schedule_same_number(std::uint32_t patch, const WorkItem& item,
                                   const Allocation& allocation,
                                   std::vector<RayGroup>& groups) const {
    double before = 0;
    for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
        const double rays = std::round(input_.options.rays * allocation.rays(k)); // N_tr
        const double first = std::max(before, item.from);
        const double here = std::min(before + rays, item.to) - first;
        if (here > 0)
            groups.push_back({patch, allocation.cells[k], ray_number(before), ray_number(first),
                              static_cast<std::uint32_t>(here), 1 / rays});
        before += rays;
    }
}

} // namespace hemilux
