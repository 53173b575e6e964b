#include "radiosity/shooting.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hemilux {
namespace {

/// Patches that one thread takes at a time, and patches whose rays are kept until they are summed.
constexpr std::size_t patches_per_volley = 32;
constexpr double rays_per_batch = 2e6;
/// Fewer rays than this are traced sooner than other threads would be started.
constexpr double rays_for_one_thread = 2000;

/// Literal steps shoot as many rays for the last of the power as for the first; they end when this
/// share of the emitted power is left.
constexpr double literal_rest = 1e-4;

} // namespace

ShootingSolver::ShootingSolver(const SolverInput& input, MakeStrategy make_strategy)
    : StepwiseSolver(input, !input.options.literal), workers_(input.options.threads),
      hemisphere_(input.options.depth) {
    const auto start = std::chrono::steady_clock::now();
    input_.monitor.phase = "density";
    strategy_ = make_strategy(input_, hemisphere_, workers_);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    solution_.seconds_density = elapsed.count();
    solution_.rays_density = strategy_->density_rays();
    solution_.rays_density_spared = strategy_->density_rays_spared();
    solution_.bytes_density = strategy_->density_bytes();
}

bool ShootingSolver::solve_once(std::uint64_t stream, StepResult& result) {
    strategy_->begin_step(stream); // the pilot's is after all others
    const auto patches = input_.mesh.patches();
    std::vector<Vec3> unshot(patches.size()), received(patches.size());
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        unshot[i] = result.radiosity[i] * patches[i].area;
    for (std::uint64_t bounces = 0;; ++bounces) {
        double left = 0;
        for (const Vec3& power : unshot)
            left += mean_of_channels(power);
        if (!(left > (input_.options.literal ? literal_rest * emitted() : 0.0)))
            return true;
        result.shot += left;
        std::ranges::fill(received, Vec3(0.0));
        const std::uint64_t rays =
            bounce(hash_words({input_.options.seed, stream, bounces}), unshot, received, result);
        if (input_.monitor.interrupted)
            return false;
        if (rays == 0) // what was left is below one ray, and chance has ended it
            return true;
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const Vec3& reflectance = input_.mesh.material(i).reflectance;
            result.absorbed += (1.0 - reflectance) * received[i];
            unshot[i] = reflectance * received[i];
            if (patches[i].area > 0)
                result.radiosity[i] += unshot[i] / patches[i].area;
        }
    }
}

std::uint64_t ShootingSolver::bounce(std::uint64_t stream, const std::vector<Vec3>& unshot,
                                     std::vector<Vec3>& received, StepResult& result) {
    plan(stream, unshot);
    const std::size_t patches = unshot.size();
    const std::uint64_t before = result.rays;
    const double planned = rays_before_[patches] - rays_before_[0];
    const Workers workers = planned < rays_for_one_thread ? Workers(1) : workers_;
    std::vector<Volley> volleys;
    for (std::size_t begin = 0; begin < patches;) {
        std::size_t end = begin;
        while (end < patches && rays_before_[end] - rays_before_[begin] <= rays_per_batch)
            end = std::min(end + patches_per_volley, patches);
        volleys.resize((end - begin + patches_per_volley - 1) / patches_per_volley);
        workers.for_chunks(end - begin, patches_per_volley,
                           [&](std::size_t first, std::size_t last) {
                               Volley& volley = volleys[first / patches_per_volley];
                               volley.bursts.clear();
                               volley.receivers.clear();
                               if (input_.monitor.interrupted)
                                   return;
                               std::vector<CellShare> shares;
                               for (std::size_t i = begin + first; i < begin + last; ++i)
                                   if (mean_of_channels(unshot[i]) > 0)
                                       shoot(static_cast<std::uint32_t>(i), stream, shares, volley);
                               trace(volley);
                               input_.monitor.rays += volley.receivers.size();
                           });
        for (const Volley& volley : volleys)
            collect(volley, unshot, received, result);
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(result.rays) /
                              (input_.options.rays * static_cast<double>(patches)));
        begin = end;
    }
    return result.rays - before;
}

/// In the order of patches and rays, whatever thread traced them.
void ShootingSolver::collect(const Volley& volley, const std::vector<Vec3>& unshot,
                             std::vector<Vec3>& received, StepResult& result) {
    std::size_t ray = 0;
    for (const Burst& burst : volley.bursts) {
        const Vec3 power = burst.ray_power * unshot[burst.patch]; // Phi_ray
        if (strategy_->learns())
            strategy_->learn(burst.patch, burst.cell,
                             std::span(volley.receivers).subspan(ray, burst.rays));
        for (std::uint32_t k = 0; k < burst.rays; ++k) {
            const std::uint32_t receiver = volley.receivers[ray++];
            if (receiver == escaped) {
                result.escaped += power;
            } else if (receiver == absorbed) {
                result.absorbed += power;
            } else {
                received[receiver] += power;
                ++result.hits[receiver];
            }
        }
    }
    result.rays += ray;
}

/// Rays in proportion to the power to be shot. Patch i owns the interval from rays_before_[i] to
/// rays_before_[i+1] of a line on which a ray stands at each whole number: as the line's origin is
/// random, each patch and each cell gets its expected number on average, rounded up or down.
void ShootingSolver::plan(std::uint64_t stream, const std::vector<Vec3>& unshot) {
    rays_before_.resize(unshot.size() + 1);
    rays_before_[0] = Rng(stream).uniform();
    for (std::size_t i = 0; i < unshot.size(); ++i) {
        const double power = mean_of_channels(unshot[i]);
        const double rays =
            input_.options.literal ? (power > 0 ? input_.options.rays : 0) : power / ray_power();
        rays_before_[i + 1] = rays_before_[i] + rays;
    }
}

void ShootingSolver::shoot(std::uint32_t patch, std::uint64_t stream,
                           std::vector<CellShare>& shares, Volley& volley) const {
    const double before = rays_before_[patch], after = rays_before_[patch + 1];
    const bool literal = input_.options.literal;
    if (!literal && std::floor(after) == std::floor(before))
        return;
    strategy_->deal(patch, shares);
    Rng rng(hash_words({stream, patch}));
    const Frame frame = input_.mesh.hemisphere_frame(patch);
    double dealt = 0; // share of the patch's rays that the cells so far own
    double low = std::floor(before);
    for (const CellShare& share : shares) {
        dealt += share.rays;
        const bool last = &share == &shares.back();
        const double high =
            std::floor(last ? after : before + (after - before) * std::min(dealt, 1.0));
        const double expected = (after - before) * share.rays; // N_tr
        const double n = literal ? std::round(expected) : high - low;
        low = high;
        if (!(n > 0))
            continue;
        // Below one ray per cell, the ray that is shot carries the power of those that are not.
        const double sharing = literal || expected >= 1 ? n : expected;
        const auto own = strategy_->private_cell(patch, share.cell);
        const double ray_power = (own ? own->power : share.power) / sharing;
        const Aim target = aim(patch, share.cell, own);
        volley.bursts.push_back({patch, share.cell, static_cast<std::uint32_t>(n), ray_power});
        for (double k = 0; k < n; ++k) {
            volley.waiting.push_back(draw(input_.mesh.patches()[patch], frame, target, rng));
            if (volley.waiting.size() == rays_at_a_time)
                trace(volley);
        }
    }
}

/// As printed, rays into triangles leave from the centre; those of plain Monte Carlo do not.
ShootingSolver::Aim ShootingSolver::aim(std::uint32_t patch, std::uint16_t cell,
                                        const std::optional<PrivateCell>& own) const {
    const Patch& from = input_.mesh.patches()[patch];
    if (!own && cell == whole_hemisphere)
        return {&from.shape, {}, nullptr};
    const Polygon* origins = own ? &own->origins : &from.shape;
    const SphericalTriangle& triangle = own ? own->shape : hemisphere_.cells()[cell].shape;
    if (!input_.options.literal)
        return {origins, {}, &triangle};
    return {nullptr, own ? origins->centre() : from.centre, &triangle};
}

Ray ShootingSolver::draw(const Patch& from, const Frame& frame, const Aim& aim, Rng& rng) {
    Ray ray{};
    ray.from = from.facet;
    ray.origin = aim.origins ? sample_uniform(*aim.origins, rng) : aim.centre;
    ray.direction =
        frame.to_world(aim.triangle ? aim.triangle->sample_rejection([&] { return rng.uniform(); })
                                    : sample_cosine(rng));
    return ray;
}

void ShootingSolver::trace(Volley& volley) const {
    find_receivers(volley.waiting, input_.mesh, input_.tracer, volley.receivers);
    volley.waiting.clear();
}

} // namespace hemilux
