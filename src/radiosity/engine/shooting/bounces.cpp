#include "radiosity/engine/shooting/bounces.h"

#include "radiosity/engine/rays/receivers.h"
#include "radiosity/engine/shooting/systematic_cells.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace hemilux {
namespace {

/// The number of work items whose receivers are kept until they are summed: about two million rays.
constexpr std::size_t items_at_once = 244;
/// Fewer rays than this are traced before other threads could come to help.
constexpr double rays_for_one_thread = 500;

/// Where all patches shoot the same number of rays, the last of the power costs as many rays as the
/// first. Such a step ends when this share of the emitted power is left.
constexpr double rest_of_same_number = 1e-4;

constexpr std::size_t bits_of_word = 64;

/// This stands for the receiver of a ray whose power is carried by separate rays.
constexpr std::uint32_t shot_separately = 0xfffffffd;

} // namespace

ShootingTools::ShootingTools(const SolverInput& its_input, const ShootingRules& its_rules,
                             int depth, std::unique_ptr<Strategy> its_strategy)
    : input(its_input), rules(its_rules), hemisphere(depth), directions(hemisphere, rules.area),
      turns(input.mesh.patches().size()), strategy(std::move(its_strategy)) {
    for (std::uint32_t patch = 0; Vec2 & turn : turns)
        turn = Mesh::hemisphere_turn(patch++);
}

bool Bounces::shoot(const StepTask& task, StepResult& result) {
    task_ = &task;
    begin(result);
    const double spent = rays_by_power() ? 0 : rest_of_same_number * left_;
    for (std::uint64_t bounces = 0;; ++bounces) {
        check_bounces(input_.mesh, bounces, task_->number);
        if (!(left_ > spent))
            return true;
        result.shot += left_;
        const std::uint64_t rays =
            bounce(hash_words({input_.options.seed, task_->stream, bounces}), result);
        if (input_.monitor.interrupted)
            return false;
        if (rays == 0) // what was left is below one ray, and chance has ended it
            return true;
        reflect(result);
    }
}

void Bounces::begin(const StepResult& result) {
    const auto patches = input_.mesh.patches();
    unshot_.resize(patches.size());
    received_.assign(patches.size(), {});
    hit_.assign(patches.size() / bits_of_word + 1, 0);
    senders_.clear();
    left_ = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        add_sender(i, result.radiosity[i] * patches[i].area);
}

void Bounces::add_sender(std::uint32_t patch, const Vec3& power) {
    check_finite(input_.mesh, patch, power, "the power to be shot", task_->number);
    const double mean = mean_of_channels(power);
    if (!(mean > 0))
        return;
    left_ += mean;
    unshot_[patch] = power;
    senders_.push_back(patch);
}

std::uint64_t Bounces::bounce(std::uint64_t stream, StepResult& result) {
    plan(stream);
    const std::uint64_t before = result.rays;
    const bool few = rays_before_.back() - rays_before_[0] < rays_for_one_thread;
    const Workers workers = few ? Workers(1) : task_->workers;
    Place next{0, rays_by_power() ? whole_below(rays_before_[0]) : 0};
    while (cut(next) && !input_.monitor.interrupted)
        shoot_items(workers, stream, result);
    if (task_->separate && !input_.monitor.interrupted)
        task_->separate->shoot(input_, {senders_, unshot_, task_->ray_power}, stream, workers,
                               [&](const SeparateShots& shots) { collect(shots, result); });
    return result.rays - before;
}

void Bounces::shoot_items(const Workers& workers, std::uint64_t stream, StepResult& result) {
    batches_.resize(std::min(items_at_once, items_.size()));
    for (std::size_t begin = 0; begin < items_.size(); begin += items_at_once) {
        const std::size_t count = std::min(items_at_once, items_.size() - begin);
        workers.for_each_in_order(
            count, [&](std::size_t k) { shoot_item(items_[begin + k], stream, batches_[k]); },
            [&](std::size_t k) {
                if (!input_.monitor.interrupted) // else batches may not be whole
                    collect(batches_[k], result);
            });
        if (input_.monitor.interrupted)
            break;
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(result.rays) /
                              (input_.options.rays * static_cast<double>(unshot_.size())));
    }
}

void Bounces::shoot_item(const WorkItem& item, std::uint64_t stream, RayBatch& batch) const {
    batch.groups.clear();
    batch.receivers.clear();
    batch.arrivals.clear();
    if (input_.monitor.interrupted)
        return;
    schedule(item, batch.groups);
    trace(stream, batch);
    input_.monitor.rays += batch.receivers.size();
}

/// Collects in the order of patches and rays, whichever thread traced them.
void Bounces::collect(const RayBatch& batch, StepResult& result) {
    const std::uint32_t* receivers = batch.receivers.data();
    for (auto group = batch.groups.begin(); group != batch.groups.end();) {
        const std::uint32_t patch = group->patch;
        const Vec3 held = unshot_[patch];
        double sent = 0, lost_in_open = 0, lost_on_backs = 0; // shares of what the patch held
        for (; group != batch.groups.end() && group->patch == patch; ++group) {
            Lost lost;
            receive(group->ray_power * held, {receivers, group->rays}, lost);
            receivers += group->rays;
            sent += (group->rays - lost.separate) * group->ray_power;
            lost_in_open += lost.escaped * group->ray_power;
            lost_on_backs += lost.absorbed * group->ray_power;
        }
        result.sent += sent * held;
        if (lost_in_open > 0)
            result.escaped += lost_in_open * held;
        if (lost_on_backs > 0)
            result.absorbed += lost_on_backs * held;
    }
    if (learns())
        teach(batch);
    result.rays += batch.receivers.size();
}

void Bounces::collect(const SeparateShots& shots, StepResult& result) {
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

/// Each ray brings `power`, which is Phi_ray.
void Bounces::receive(const Vec3& power, std::span<const std::uint32_t> receivers, Lost& lost) {
    for (const std::uint32_t receiver : receivers) {
        if (receiver >= received_.size()) {
            ++(receiver == escaped    ? lost.escaped
               : receiver == absorbed ? lost.absorbed
                                      : lost.separate);
            continue;
        }
        hit_[receiver / bits_of_word] |= std::uint64_t{1} << receiver % bits_of_word;
        ++received_[receiver].rays;
        received_[receiver].power += power;
    }
}

void Bounces::teach(const RayBatch& batch) const {
    std::size_t ray = 0;
    for (const RayGroup& group : batch.groups) {
        hook_->learn(group.patch, group.cell, std::span(batch.receivers).subspan(ray, group.rays),
                     std::span(batch.arrivals).subspan(ray, group.rays));
        ray += group.rays;
    }
}

/// Absorbs a part of what arrived and adds the rest to the power to be shot, in the order of
/// patches.
void Bounces::reflect(StepResult& result) {
    senders_.clear();
    left_ = 0;
    for (std::size_t word = 0; word < hit_.size(); ++word)
        for (std::uint64_t bits = std::exchange(hit_[word], 0); bits != 0; bits &= bits - 1) {
            const auto i = static_cast<std::uint32_t>(word * bits_of_word) +
                           static_cast<std::uint32_t>(std::countr_zero(bits));
            const Arrived arrived = std::exchange(received_[i], {});
            const Vec3& reflectance = input_.mesh.material(i).reflectance;
            const Vec3 power = arrived.power.value(), reflected = reflectance * power;
            result.hits[i] += arrived.rays;
            result.absorbed += (1.0 - reflectance) * power;
            const double area = input_.mesh.patches()[i].area;
            if (area > 0)
                result.radiosity[i] += reflected / area;
            add_sender(i, reflected);
        }
}

void Bounces::trace(std::uint64_t stream, RayBatch& batch) const {
    thread_local std::vector<Ray> memory;
    const RaySource source{input_.mesh, tools_.turns, tools_.directions, *tools_.strategy,
                           tools_.rules.origins};
    GroupedRays drawn(source, batch.groups, stream, memory);
    for (auto rays = drawn.next(); !rays.empty(); rays = drawn.next()) {
        if (input_.monitor.interrupted) // one emitter may shoot many millions
            return;
        find_receivers(rays, input_.mesh, input_.tracer, batch.receivers);
        const std::span<std::uint32_t> receivers = std::span(batch.receivers).last(rays.size());
        if (task_->separate)
            drawn.for_each_patch([&](std::size_t k, std::uint32_t patch) {
                if (task_->separate->carry(patch, rays[k]))
                    receivers[k] = shot_separately;
            });
        if (learns())
            hook_->find_arrivals(rays, receivers, batch.arrivals);
    }
}

} // namespace hemilux
