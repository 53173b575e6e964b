#include "radiosity/bounces.h"

#include "radiosity/mesh.h"
#include "radiosity/rng.h"
#include "radiosity/shot.h"
#include "radiosity/solve_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

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

constexpr std::size_t bits_of_word = 64;

/// std::floor for numbers of rays; compilers call a function for that.
double whole_below(double rays) { return static_cast<double>(static_cast<std::int64_t>(rays)); }

/// A line on which a patch's cells own intervals one after the other, and a ray stands at each
/// whole number.
class LineOfCells {
  public:
    LineOfCells(const Dealing& dealing, double before, double after)
        : dealing_(dealing), before_(before), after_(after),
          rays_((after - before) / dealing.rays_up_to.back()) {}

    /// Calls found(cell, expected, low, high) for each cell with rays: expected, which is N_tr, and
    /// those from low + 1 to high. Most have none when the light is nearly spent.
    template <class Found>
    void for_each_cell(const Found& found) const {
        constexpr std::size_t block = 16;
        std::array<std::size_t, block> cell;
        std::array<double, block> high;
        double low = whole_below(before_);
        for (std::size_t begin = 0, cells = dealing_.cells.size(); begin < cells; begin += block) {
            const std::size_t end = std::min(begin + block, cells);
            if (end_of(end - 1) < low + 1)
                continue;
            std::size_t count = 0;
            double before = low;
            for (std::size_t k = begin; k < end; ++k) { // a branch would be guessed wrong
                const double after = whole_below(end_of(k));
                cell[count] = k;
                high[count] = after;
                count += after > before;
                before = after;
            }
            for (std::size_t i = 0; i < count; ++i) {
                found(dealing_.cells[cell[i]], rays_ * dealing_.rays(cell[i]), low, high[i]);
                low = high[i];
            }
        }
    }

  private:
    [[nodiscard]] double end_of(std::size_t cell) const {
        return cell + 1 == dealing_.cells.size() ? after_
                                                 : before_ + rays_ * dealing_.rays_up_to[cell];
    }

    const Dealing& dealing_;
    double before_, after_;
    double rays_; ///< for one unit of the running sums
};

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
    const double rays_a_piece = cut();
    const std::uint64_t before = result.rays;
    const bool few = rays_before_.back() - rays_before_[0] < rays_for_one_thread;
    const Workers workers = few ? Workers(1) : task_->workers;
    const auto most = static_cast<std::size_t>(std::ceil(rays_per_batch / rays_a_piece));
    volleys_.resize(std::min(most, pieces_.size()));
    for (std::size_t begin = 0; begin < pieces_.size(); begin += most) {
        const std::size_t count = std::min(most, pieces_.size() - begin);
        workers.for_each_in_order(
            count, [&](std::size_t k) { fire(pieces_[begin + k], stream, volleys_[k]); },
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
    return result.rays - before;
}

void Bounces::fire(const Piece& piece, std::uint64_t stream, Volley& volley) const {
    volley.bursts.clear();
    volley.receivers.clear();
    volley.arrivals.clear();
    if (input_.monitor.interrupted)
        return;
    thread_local DealtCells memory;
    for (std::size_t k = piece.first; k < piece.last; ++k) {
        const double first = std::max(whole_below(rays_before_[k]), piece.from);
        const double last = std::min(whole_below(rays_before_[k + 1]), piece.to);
        if (input_.options.literal)
            order_as_printed(senders_[k], tools_.strategy->deal(senders_[k], memory),
                             volley.bursts);
        else if (last > first)
            order(k, piece, tools_.strategy->deal(senders_[k], memory), volley.bursts);
    }
    trace(hash_words({stream, static_cast<std::uint64_t>(piece.from)}), volley);
    input_.monitor.rays += volley.receivers.size();
}

/// In the order of patches and rays, whatever thread traced them.
void Bounces::collect(const Volley& volley, StepResult& result) {
    std::size_t ray = 0;
    for (const Burst& burst : volley.bursts) {
        const Vec3 power = burst.ray_power * unshot_[burst.patch]; // Phi_ray
        if (tools_.strategy->learns())
            tools_.strategy->learn(burst.patch, burst.cell,
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
                Arrived& arrived = received_[receiver];
                if (arrived.rays++ == 0)
                    struck_[receiver / bits_of_word] |= std::uint64_t{1} << receiver % bits_of_word;
                arrived.power += power;
            }
        }
        result.sent += double(burst.rays) * power;
        result.escaped += double(rays_escaped) * power;
        result.absorbed += double(rays_absorbed) * power;
    }
    result.rays += ray;
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

/// Pieces of equal numbers of rays, so that no thread waits long for another: a lamp may shoot half
/// of a bounce. They do not depend on the number of threads. Returns the rays of one.
double Bounces::cut() {
    pieces_.clear();
    const auto senders = static_cast<std::uint32_t>(senders_.size());
    if (input_.options.literal) { // rays do not stand on the line
        for (std::uint32_t k = 0; k < senders; k += patches_per_piece)
            pieces_.push_back({k, std::min(k + patches_per_piece, senders), 0,
                               std::numeric_limits<double>::infinity()});
        return patches_per_piece * input_.options.rays;
    }
    const double first = whole_below(rays_before_[0]), end = whole_below(rays_before_.back());
    const double size =
        std::clamp(std::ceil((end - first) / pieces_a_bounce), least_piece, largest_piece);
    const auto sender_of = [&](double ray) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(rays_before_, ray) -
                                          rays_before_.begin() - 1);
    };
    for (double from = first; from < end; from += size) {
        const double to = std::min(from + size, end);
        pieces_.push_back({sender_of(from + 1), sender_of(to) + 1, from, to});
    }
    return size;
}

void Bounces::order(std::size_t sender, const Piece& piece, const Dealing& dealing,
                    std::vector<Burst>& bursts) const {
    const std::uint32_t patch = senders_[sender];
    const LineOfCells line(dealing, rays_before_[sender], rays_before_[sender + 1]);
    line.for_each_cell([&](std::uint16_t cell, double expected, double low, double high) {
        const double here = std::min(high, piece.to) - std::max(low, piece.from);
        // Below one ray per cell, the ray that is shot carries the power of those that are not.
        const double sharing = expected >= 1 ? high - low : expected;
        if (here > 0)
            bursts.push_back({patch, cell, static_cast<std::uint32_t>(here), 1 / sharing});
    });
}

void Bounces::order_as_printed(std::uint32_t patch, const Dealing& dealing,
                               std::vector<Burst>& bursts) const {
    for (std::size_t k = 0; k < dealing.cells.size(); ++k) {
        const double rays = std::round(input_.options.rays * dealing.rays(k)); // N_tr
        if (rays > 0)
            bursts.push_back({patch, dealing.cells[k], static_cast<std::uint32_t>(rays), 1 / rays});
    }
}

void Bounces::trace(std::uint64_t seed, Volley& volley) const {
    thread_local std::vector<Ray> memory;
    const RaySource source{input_.mesh, tools_.starts, tools_.directions, *tools_.strategy,
                           input_.options.literal};
    BurstRays drawn(source, volley.bursts, seed, memory);
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
