#include "radiosity/shooting/bounces.h"

#include "radiosity/rays/shot.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/scene/mesh.h"
#include "radiosity/shooting/line_of_cells.h"
#include "radiosity/solving/solve_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// Rays that one thread takes at a time: a part of those that are left of the bounce, so that at
/// its end no thread waits long for another. And rays whose receivers are kept until they are
/// summed.
constexpr double pieces_of_rest = 32, least_piece = 256, largest_piece = 8192;
constexpr std::uint32_t patches_per_piece = 32;
constexpr double rays_per_batch = 2e6;
/// Pieces that are listed at a time: a step of 1e9 rays per patch has millions.
constexpr std::size_t most_pieces = 4096;
/// A thread that works alone takes pieces of so many together: tracing likes many rays at once.
constexpr double rays_at_least = 4096;
/// Fewer rays than this are traced sooner than others would have come to help.
constexpr double rays_for_one_thread = 500;

/// Literal steps shoot as many rays for the last of the power as for the first; they end when this
/// share of the emitted power is left.
constexpr double literal_rest = 1e-4;

constexpr std::size_t bits_of_word = 64;

/// Of a ray among those of its patch. After 2^32 rays of one patch they begin anew.
std::uint32_t ray_number(double rays_before) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(rays_before));
}

} // namespace

bool Bounces::shoot(const StepTask& task, StepResult& result) {
    task_ = &task;
    begin(result);
    const double spent = input_.options.literal ? literal_rest * left_ : 0;
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
    struck_.assign(patches.size() / bits_of_word + 1, 0);
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
    Place next{0, input_.options.literal ? 0 : whole_below(rays_before_[0])};
    while (cut(next) && !input_.monitor.interrupted) {
        share_out(workers.threads() > 1 ? 0 : rays_at_least);
        shoot_shares(workers, stream, result);
    }
    return result.rays - before;
}

void Bounces::shoot_shares(const Workers& workers, std::uint64_t stream, StepResult& result) {
    const auto most = static_cast<std::size_t>(rays_per_batch / largest_piece);
    volleys_.resize(std::min(most, shares_.size()));
    for (std::size_t begin = 0; begin < shares_.size(); begin += most) {
        const std::size_t count = std::min(most, shares_.size() - begin);
        workers.for_each_in_order(
            count, [&](std::size_t k) { fire(shares_[begin + k], stream, volleys_[k]); },
            [&](std::size_t k) {
                if (!input_.monitor.interrupted) // else volleys may not be whole
                    collect(volleys_[k], result);
            });
        if (input_.monitor.interrupted)
            break;
        input_.monitor.step_share =
            std::min(1.0, static_cast<double>(result.rays) /
                              (input_.options.rays * static_cast<double>(unshot_.size())));
    }
}

/// Pieces in their order to shares of so many rays at least.
void Bounces::share_out(double rays) {
    shares_.clear();
    double from = 0;
    for (const Piece& piece : pieces_) {
        if (shares_.empty() || piece.to - from >= rays) {
            const std::size_t first = shares_.empty() ? 0 : shares_.back().last;
            shares_.push_back({first, first});
            from = piece.from;
        }
        ++shares_.back().last;
    }
}

void Bounces::fire(const Share& share, std::uint64_t stream, Volley& volley) const {
    volley.bursts.clear();
    volley.receivers.clear();
    volley.arrivals.clear();
    if (input_.monitor.interrupted)
        return;
    for (std::size_t k = share.first; k < share.last; ++k)
        order(pieces_[k], volley.bursts);
    trace(stream, volley);
    input_.monitor.rays += volley.receivers.size();
}

void Bounces::order(const Piece& piece, std::vector<Burst>& bursts) const {
    thread_local DealtCells memory;
    const auto deal = [&](std::size_t k) { return tools_.strategy->deal(senders_[k], memory); };
    if (input_.options.literal) {
        for (std::size_t k = piece.first; k < piece.last; ++k)
            order_as_printed(senders_[k], piece, deal(k), bursts);
        return;
    }
    double last = whole_below(rays_before_[piece.first]);
    for (std::size_t k = piece.first; k < piece.last; ++k) {
        const double first = std::exchange(last, whole_below(rays_before_[k + 1]));
        if (std::min(last, piece.to) > std::max(first, piece.from))
            order(k, piece, deal(k), bursts);
    }
}

/// In the order of patches and rays, whatever thread traced them.
void Bounces::collect(const Volley& volley, StepResult& result) {
    const std::uint32_t* receivers = volley.receivers.data();
    for (auto burst = volley.bursts.begin(); burst != volley.bursts.end();) {
        const std::uint32_t patch = burst->patch;
        const Vec3 held = unshot_[patch];
        double sent = 0, lost_in_open = 0, lost_on_backs = 0; // shares of what the patch held
        for (; burst != volley.bursts.end() && burst->patch == patch; ++burst) {
            const auto [rays_escaped, rays_absorbed] =
                receive(burst->ray_power * held, {receivers, burst->rays});
            receivers += burst->rays;
            sent += burst->rays * burst->ray_power;
            lost_in_open += rays_escaped * burst->ray_power;
            lost_on_backs += rays_absorbed * burst->ray_power;
        }
        result.sent += sent * held;
        if (lost_in_open > 0)
            result.escaped += lost_in_open * held;
        if (lost_on_backs > 0)
            result.absorbed += lost_on_backs * held;
    }
    if (tools_.strategy->learns())
        teach(volley);
    result.rays += volley.receivers.size();
}

/// Each brings `power`, which is Phi_ray. Returns how many escaped, and how many were absorbed.
std::array<std::uint32_t, 2> Bounces::receive(const Vec3& power,
                                              std::span<const std::uint32_t> receivers) {
    std::array<std::uint32_t, 2> lost{};
    for (const std::uint32_t receiver : receivers) {
        if (receiver >= received_.size()) {
            ++lost[receiver == escaped ? 0 : 1];
            continue;
        }
        struck_[receiver / bits_of_word] |= std::uint64_t{1} << receiver % bits_of_word;
        ++received_[receiver].rays;
        received_[receiver].power += power;
    }
    return lost;
}

void Bounces::teach(const Volley& volley) const {
    std::size_t ray = 0;
    for (const Burst& burst : volley.bursts) {
        tools_.strategy->learn(burst.patch, burst.cell,
                               std::span(volley.receivers).subspan(ray, burst.rays),
                               std::span(volley.arrivals).subspan(ray, burst.rays));
        ray += burst.rays;
    }
}

/// What arrived is absorbed or to be shot, in the order of patches.
void Bounces::reflect(StepResult& result) {
    senders_.clear();
    left_ = 0;
    for (std::size_t word = 0; word < struck_.size(); ++word)
        for (std::uint64_t bits = std::exchange(struck_[word], 0); bits != 0; bits &= bits - 1) {
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

/// Rays in proportion to the power to be shot, times the strategy's factor. Sender k owns the
/// interval from rays_before_[k] to rays_before_[k+1] of a line on which a ray stands at each whole
/// number: as the line's origin is random, each patch and each cell gets its expected number on
/// average, rounded up or down.
void Bounces::plan(std::uint64_t stream) {
    rays_before_.resize(senders_.size() + 1);
    rays_before_[0] = Rng(stream).uniform();
    for (std::size_t k = 0; k < senders_.size(); ++k) {
        const std::uint32_t i = senders_[k];
        const double rays = input_.options.literal
                                ? input_.options.rays
                                : mean_of_channels(unshot_[i]) / task_->ray_power *
                                      tools_.strategy->rays_for_power(i);
        rays_before_[k + 1] = rays_before_[k] + rays;
    }
}

/// By numbers of rays, as a lamp may shoot half of a bounce. Pieces do not depend on the number of
/// threads.
bool Bounces::cut(Place& next) {
    pieces_.clear();
    if (input_.options.literal)
        cut_as_printed(next);
    else
        cut_line(next);
    return !pieces_.empty();
}

void Bounces::cut_line(Place& next) {
    const double end = whole_below(rays_before_.back());
    const auto sender_of = [&](double ray) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(rays_before_, ray) -
                                          rays_before_.begin() - 1);
    };
    for (double& from = next.ray; from < end && pieces_.size() < most_pieces;) {
        const double size =
            std::clamp(std::ceil((end - from) / pieces_of_rest), least_piece, largest_piece);
        const double to = std::min(from + size, end);
        pieces_.push_back({sender_of(from + 1), sender_of(to) + 1, from, to});
        from = to;
    }
}

/// Rays do not stand on the line: each sender has as many, which are counted from 0. Where these
/// are many a piece is a part of them.
void Bounces::cut_as_printed(Place& next) {
    const auto senders = static_cast<std::uint32_t>(senders_.size());
    const bool whole = input_.options.rays <= largest_piece;
    while (next.sender < senders && pieces_.size() < most_pieces) {
        const std::uint32_t last = std::min(next.sender + (whole ? patches_per_piece : 1), senders);
        const double end = std::numeric_limits<double>::infinity();
        const bool is_last = whole || next.ray + largest_piece >= input_.options.rays;
        pieces_.push_back({next.sender, last, next.ray, is_last ? end : next.ray + largest_piece});
        next = is_last ? Place{last, 0} : Place{next.sender, next.ray + largest_piece};
    }
}

void Bounces::order(std::size_t sender, const Piece& piece, const Dealing& dealing,
                    std::vector<Burst>& bursts) const {
    const std::uint32_t patch = senders_[sender];
    const LineOfCells line(dealing, rays_before_[sender], rays_before_[sender + 1]);
    const double before = whole_below(rays_before_[sender]);
    line.for_each_cell([&](std::uint16_t cell, double expected, double low, double high) {
        const double first = std::max(low, piece.from), here = std::min(high, piece.to) - first;
        // Below one ray per cell, the ray that is shot carries the power of those that are not.
        const double sharing = expected >= 1 ? high - low : expected;
        if (here > 0)
            bursts.push_back({patch, cell, ray_number(first - before),
                              static_cast<std::uint32_t>(here), 1 / sharing});
    });
}

void Bounces::order_as_printed(std::uint32_t patch, const Piece& piece, const Dealing& dealing,
                               std::vector<Burst>& bursts) const {
    double before = 0;
    for (std::size_t k = 0; k < dealing.cells.size(); ++k) {
        const double rays = std::round(input_.options.rays * dealing.rays(k)); // N_tr
        const double first = std::max(before, piece.from);
        const double here = std::min(before + rays, piece.to) - first;
        if (here > 0)
            bursts.push_back({patch, dealing.cells[k], ray_number(first),
                              static_cast<std::uint32_t>(here), 1 / rays});
        before += rays;
    }
}

void Bounces::trace(std::uint64_t stream, Volley& volley) const {
    thread_local std::vector<Ray> memory;
    const RaySource source{input_.mesh, tools_.starts, tools_.directions, *tools_.strategy,
                           input_.options.literal};
    BurstRays drawn(source, volley.bursts, stream, memory);
    for (auto rays = drawn.next(); !rays.empty(); rays = drawn.next()) {
        if (input_.monitor.interrupted) // one lamp may shoot many millions
            return;
        find_receivers(rays, input_.mesh, input_.tracer, volley.receivers);
        if (tools_.strategy->learns())
            tools_.strategy->find_arrivals(rays, std::span(volley.receivers).last(rays.size()),
                                           volley.arrivals);
    }
}

} // namespace hemilux
