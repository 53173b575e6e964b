#include "radiosity/shooting.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/solve_error.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// Rays that one thread takes at a time, and rays whose receivers are kept until they are summed.
constexpr double pieces_a_bounce = 64, least_piece = 512, largest_piece = 8192;
constexpr std::uint32_t patches_per_piece = 32;
constexpr double rays_per_batch = 2e6;
/// Fewer rays than this are traced sooner than other threads would be started.
constexpr double rays_for_one_thread = 2000;

/// Literal steps shoot as many rays for the last of the power as for the first; they end when this
/// share of the emitted power is left.
constexpr double literal_rest = 1e-4;

/// std::floor for numbers of rays; compilers call a function for that.
double whole_below(double rays) { return static_cast<double>(static_cast<std::int64_t>(rays)); }

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
    if (stream != pilot_stream)
        strategy_->prepare(estimate(), ray_power());
    strategy_->begin_step(stream); // the pilot's is after all others
    if (!shoot_all_bounces(stream, result))
        return false;
    strategy_->end_step();
    return true;
}

/// False when interrupted.
bool ShootingSolver::shoot_all_bounces(std::uint64_t stream, StepResult& result) {
    const auto patches = input_.mesh.patches();
    std::vector<Vec3> unshot(patches.size());
    Received received(patches.size());
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        unshot[i] = result.radiosity[i] * patches[i].area;
    for (std::uint64_t bounces = 0;; ++bounces) {
        double left = 0;
        for (const Vec3& power : unshot)
            left += mean_of_channels(power);
        check_finite(input_.mesh, unshot, "the power to be shot", step_under_way());
        check_bounces(bounces);
        if (!(left > (input_.options.literal ? literal_rest * emitted() : 0.0)))
            return true;
        result.shot += left;
        std::ranges::fill(received, CompensatedSum<Vec3>{});
        const std::uint64_t rays =
            bounce(hash_words({input_.options.seed, stream, bounces}), unshot, received, result);
        if (input_.monitor.interrupted)
            return false;
        if (rays == 0) // what was left is below one ray, and chance has ended it
            return true;
        for (std::uint32_t i = 0; i < patches.size(); ++i) {
            const Vec3& reflectance = input_.mesh.material(i).reflectance;
            const Vec3 power = received[i].value();
            result.absorbed += (1.0 - reflectance) * power;
            unshot[i] = reflectance * power;
            if (patches[i].area > 0)
                result.radiosity[i] += unshot[i] / patches[i].area;
        }
    }
}

std::uint64_t ShootingSolver::bounce(std::uint64_t stream, const std::vector<Vec3>& unshot,
                                     Received& received, StepResult& result) {
    plan(stream, unshot);
    const double rays_a_piece = cut();
    const std::uint64_t before = result.rays;
    const bool few = rays_before_.back() - rays_before_[0] < rays_for_one_thread;
    const Workers workers = few ? Workers(1) : workers_;
    const auto most = static_cast<std::size_t>(std::ceil(rays_per_batch / rays_a_piece));
    volleys_.resize(std::min(most, pieces_.size()));
    for (std::size_t begin = 0; begin < pieces_.size(); begin += most) {
        const std::size_t count = std::min(most, pieces_.size() - begin);
        workers.for_each_in_order(
            count, [&](std::size_t k) { fire(pieces_[begin + k], stream, unshot, volleys_[k]); },
            [&](std::size_t k) {
                if (!input_.monitor.interrupted) // else volleys may not be whole
                    collect(volleys_[k], unshot, received, result);
            });
        if (input_.monitor.interrupted)
            break;
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(result.rays) /
                              (input_.options.rays * static_cast<double>(unshot.size())));
    }
    return result.rays - before;
}

void ShootingSolver::fire(const Piece& piece, std::uint64_t stream, const std::vector<Vec3>& unshot,
                          Volley& volley) const {
    volley.bursts.clear();
    volley.receivers.clear();
    volley.arrivals.clear();
    if (input_.monitor.interrupted)
        return;
    std::vector<CellShare> shares;
    volley.waiting.reserve(rays_at_a_time);
    for (std::uint32_t i = piece.first; i < piece.last; ++i)
        if (mean_of_channels(unshot[i]) > 0)
            shoot(i, piece, stream, shares, volley);
    trace(volley);
    volley.waiting = {};
    input_.monitor.rays += volley.receivers.size();
}

/// In the order of patches and rays, whatever thread traced them.
void ShootingSolver::collect(const Volley& volley, const std::vector<Vec3>& unshot,
                             Received& received, StepResult& result) {
    std::size_t ray = 0;
    for (const Burst& burst : volley.bursts) {
        const Vec3 power = burst.ray_power * unshot[burst.patch]; // Phi_ray
        if (strategy_->learns())
            strategy_->learn(burst.patch, burst.cell,
                             std::span(volley.receivers).subspan(ray, burst.rays),
                             std::span(volley.arrivals).subspan(ray, burst.rays));
        std::uint32_t rays_escaped = 0, rays_absorbed = 0;
        for (std::uint32_t k = 0; k < burst.rays; ++k) {
            const std::uint32_t receiver = volley.receivers[ray++];
            if (receiver == escaped) {
                ++rays_escaped;
            } else if (receiver == absorbed) {
                ++rays_absorbed;
            } else {
                received[receiver] += power;
                ++result.hits[receiver];
            }
        }
        result.sent += double(burst.rays) * power;
        result.escaped += double(rays_escaped) * power;
        result.absorbed += double(rays_absorbed) * power;
    }
    result.rays += ray;
}

/// Rays in proportion to the power to be shot, times the strategy's factor. Patch i owns the
/// interval from rays_before_[i] to rays_before_[i+1] of a line on which a ray stands at each whole
/// number: as the line's origin is random, each patch and each cell gets its expected number on
/// average, rounded up or down.
void ShootingSolver::plan(std::uint64_t stream, const std::vector<Vec3>& unshot) {
    rays_before_.resize(unshot.size() + 1);
    rays_before_[0] = Rng(stream).uniform();
    for (std::size_t i = 0; i < unshot.size(); ++i) {
        const double power = mean_of_channels(unshot[i]);
        const double rays =
            input_.options.literal
                ? (power > 0 ? input_.options.rays : 0)
                : power / ray_power() * strategy_->rays_for_power(static_cast<std::uint32_t>(i));
        rays_before_[i + 1] = rays_before_[i] + rays;
    }
}

/// Pieces of equal numbers of rays, so that no thread waits long for another: a lamp may shoot half
/// of a bounce. They do not depend on the number of threads. Returns the rays of one.
double ShootingSolver::cut() {
    pieces_.clear();
    const auto patches = static_cast<std::uint32_t>(rays_before_.size() - 1);
    if (input_.options.literal) { // rays do not stand on the line
        for (std::uint32_t i = 0; i < patches; i += patches_per_piece)
            pieces_.push_back({i, std::min(i + patches_per_piece, patches), 0,
                               std::numeric_limits<double>::infinity()});
        return patches_per_piece * input_.options.rays;
    }
    const double first = whole_below(rays_before_[0]), end = whole_below(rays_before_.back());
    const double size =
        std::clamp(std::ceil((end - first) / pieces_a_bounce), least_piece, largest_piece);
    const auto patch_of = [&](double ray) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(rays_before_, ray) -
                                          rays_before_.begin() - 1);
    };
    for (double from = first; from < end; from += size) {
        const double to = std::min(from + size, end);
        pieces_.push_back({patch_of(from + 1), patch_of(to) + 1, from, to});
    }
    return size;
}

void ShootingSolver::shoot(std::uint32_t patch, const Piece& piece, std::uint64_t stream,
                           std::vector<CellShare>& shares, Volley& volley) const {
    const double before = rays_before_[patch], after = rays_before_[patch + 1];
    const bool literal = input_.options.literal;
    double low = whole_below(before);
    if (!literal && !(std::min(whole_below(after), piece.to) > std::max(low, piece.from)))
        return;
    strategy_->deal(patch, shares);
    Rng rng(hash_words({stream, patch, static_cast<std::uint64_t>(piece.from)}));
    const Patch& from = input_.mesh.patches()[patch];
    const Frame frame = input_.mesh.hemisphere_frame(patch);
    const PolygonSampler whole(from.shape);
    double dealt = 0; // share of the patch's rays that the cells so far own
    for (const CellShare& share : shares) {
        dealt += share.rays;
        const bool last = &share == &shares.back();
        const double end = last ? after : before + (after - before) * std::min(dealt, 1.0);
        if (!literal && end < low + 1) // most cells, when the light is nearly spent
            continue;
        const double expected = (after - before) * share.rays; // N_tr
        const double high = whole_below(end);
        const double n = literal ? std::round(expected) : high - low;
        const double here = literal ? n : std::min(high, piece.to) - std::max(low, piece.from);
        low = high;
        if (!(here > 0))
            continue;
        // Below one ray per cell, the ray that is shot carries the power of those that are not.
        const double sharing = literal || expected >= 1 ? n : expected;
        const auto own = strategy_->private_cell(patch, share.cell);
        const double ray_power = (own ? own->power : share.power) / sharing;
        const auto part = own ? std::optional<PolygonSampler>(own->origins) : std::nullopt;
        const Aim target = aim(patch, share.cell, own, part ? *part : whole);
        volley.bursts.push_back({patch, share.cell, static_cast<std::uint32_t>(here), ray_power});
        for (double k = 0; k < here; ++k) {
            volley.waiting.push_back(draw(from, frame, target, rng));
            if (volley.waiting.size() < rays_at_a_time)
                continue;
            if (input_.monitor.interrupted) // one lamp may shoot many millions
                return;
            trace(volley);
        }
    }
}

/// As printed, rays into triangles leave from the centre; those of plain Monte Carlo do not.
ShootingSolver::Aim ShootingSolver::aim(std::uint32_t patch, std::uint16_t cell,
                                        const std::optional<PrivateCell>& own,
                                        const PolygonSampler& origins) const {
    const Patch& from = input_.mesh.patches()[patch];
    if (!own && cell == whole_hemisphere)
        return {&origins, {}, nullptr};
    const SphericalTriangle& triangle = own ? own->shape : hemisphere_.cells()[cell].shape;
    if (!input_.options.literal)
        return {&origins, {}, &triangle};
    return {nullptr, own ? own->origins.centre() : from.centre, &triangle};
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
    if (strategy_->learns())
        strategy_->find_arrivals(volley.waiting,
                                 std::span(volley.receivers).last(volley.waiting.size()),
                                 volley.arrivals);
    volley.waiting.clear();
}

} // namespace hemilux
