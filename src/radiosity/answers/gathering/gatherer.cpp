#include "radiosity/answers/gathering/gatherer.h"

#include "parallel/asked_to_end.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace hemilux {
namespace {

/// The share of the error that what gathers read may leave.
constexpr double share_of_read = .7;

/// The most rays at a place by rounds.
constexpr unsigned max_rays_of_place = 256;

/// Returns the rays at a place of a picture for an error: 16 for 2 %, and as the inverse square of
/// the error, by powers of two from 4 to 64.
unsigned rays_for(double error) {
    return 1u << static_cast<unsigned>(
               std::clamp(std::round(4 + 2 * elementary::log2(.02 / error)), 2.0, 6.0));
}

/// Returns about how many rays at a place it takes in all, of which so many left this noise beside
/// the error of what they read. They double from round to round.
double rays_needed(const GatherErrors& errors, double asked) {
    const double read = errors.read.error, left = asked * asked - read * read;
    const double excess = left > 0 ? errors.noise * errors.noise / left : 1;
    return std::min(errors.rays *
                        elementary::exp2(std::ceil(elementary::log2(std::max(excess, 2.0)))),
                    double(max_rays_of_place));
}

} // namespace

/// The rounds of one target.
class Gatherer::Rounds {
  public:
    Rounds(Gatherer& gatherer, GatherTarget& target, const ReadError& read,
           const std::optional<WholeLight>& whole)
        : gatherer_(gatherer), target_(target), whole_(whole), errors_{read},
          error_(gatherer.error_at(0, &TargetLevel::shown, whole)) {}

    [[nodiscard]] GatherErrors take();
    [[nodiscard]] double level() const { return level_; }

  private:
    /// Gathers a round. Returns whether it was gathered to its end.
    bool gather(unsigned number, unsigned rays, bool alone);
    /// Judges by so many times the usual number of places.
    void judge(std::uint64_t more);
    void judge_until_known();

    Gatherer& gatherer_;
    GatherTarget& target_;
    const std::optional<WholeLight>& whole_;
    GatherErrors errors_;
    double error_;      ///< that all of the light may have
    double level_ = 0;  ///< TargetLevel::shown
    double needed_ = 0; ///< rays at a place in all, as far as errors tell their number
    std::uint64_t judged_ = 1;
    static constexpr std::uint64_t max_more = 64;
};

bool Gatherer::Rounds::gather(unsigned number, unsigned rays, bool alone) {
    std::atomic<double>& share = gatherer_.share_;
    const double done = number == 0 ? 0 : errors_.rays, all = std::max(needed_, done + rays);
    share = done / all;
    const auto stage = gatherer_.watcher_.begin("gathering the " + target_.name(), &share);
    const Stopwatch watch;
    try {
        gatherer_.work_.rays_gather += target_.gather(
            {rays, number, alone,
             gatherer_.error_at(errors_.read.level, &TargetLevel::read, whole_), errors_.read,
             [&](double of_round) { share = (done + of_round * rays) / all; }},
            gatherer_.workers_);
    } catch (const Interrupted&) {
        if (number == 0)
            throw;
        return false; // the rounds before it are given out
    }
    errors_.rays = number % 2 == 1 ? 2 * rays : rays;
    gatherer_.work_.seconds_gather += watch.seconds();
    return true;
}

void Gatherer::Rounds::judge(std::uint64_t more) {
    constexpr std::uint64_t usual_places = 512;
    judged_ = more;
    gatherer_.share_ = 0;
    const auto stage = gatherer_.watcher_.begin("judging the " + target_.name(), &gatherer_.share_);
    const Stopwatch watch;
    const std::optional<PictureError> own =
        target_.judge(usual_places * more, gatherer_.workers_, [this](double share) {
            gatherer_.share_ = share;
            return !gatherer_.monitor_.interrupted;
        });
    gatherer_.work_.seconds_learn += watch.seconds();
    if (!own)
        return;
    gatherer_.work_.rays_learn += own->rays;
    errors_.noise = own->error;
    errors_.noise_uncertainty = own->uncertainty;
    errors_.noise_bound = own->bound;
    errors_.noise_local = own->local;
    level_ = own->level;
    error_ = gatherer_.error_at(level_, &TargetLevel::shown, whole_);
}

void Gatherer::Rounds::judge_until_known() {
    const double accuracy = gatherer_.asked_.accuracy;
    for (std::uint64_t more = 4 * judged_;
         accuracy > 0 && more <= max_more && !gatherer_.monitor_.interrupted &&
         errors_.noise * errors_.noise_uncertainty > accuracy * errors_.whole() * errors_.whole();
         more *= 4)
        judge(more);
}

GatherErrors Gatherer::Rounds::take() {
    constexpr double helps = .85;
    double before = std::numeric_limits<double>::infinity();
    bool alone = false;
    unsigned rays = gatherer_.asked_.rays.value_or(rays_for(error_)); // of the next round
    needed_ = rays;
    for (unsigned round = 0; gather(round, rays, alone); ++round) {
        judge(1);
        if (!target_.takes_rounds())
            return errors_;
        // Few places may happen to hold much: more of them cost less than to gather again, the more
        // so by more rays.
        const std::uint64_t many = round == 0 ? 16 : max_more;
        for (std::uint64_t more = 4; more <= many && !whole_ && errors_.is_in_doubt(error_);
             more *= 4)
            judge(more);
        if (errors_.is_unknown())
            break;
        gatherer_.watcher_.tell(Finding::Kind::detail,
                                target_.name() + " by " + counted(errors_.rays, "ray", "rays") +
                                    " a point: its own error is " + percent(errors_.noise) +
                                    ", that of the light which it reads " +
                                    percent(errors_.read.error));
        if (gatherer_.asked_.rays || (whole_ ? errors_.whole() : errors_.bound()) <= error_ ||
            2 * errors_.rays > max_rays_of_place || !(errors_.read.bound <= error_) ||
            gatherer_.monitor_.interrupted)
            break;
        if (errors_.noise > helps * before && std::exchange(alone, true))
            break;
        before = errors_.noise;
        needed_ = rays_needed(errors_, error_);
        rays = round % 2 == 0 ? errors_.rays : 2 * errors_.rays;
    }
    judge_until_known();
    return errors_;
}

Gatherer::Gatherer(const LitScene& scene, const Solution& solution, const Asked& asked,
                   Monitor& monitor, Watcher& watcher)
    : scene_(scene), solution_(solution), asked_(asked), monitor_(monitor), watcher_(watcher),
      workers_(asked.threads), cache_(scene.mesh, scene.tracer, solution) {}

std::uint64_t Gatherer::seed_of(std::uint64_t use) const { return hash_words({asked_.seed, use}); }

std::optional<std::uint64_t> Gatherer::rays_left() const {
    if (!asked_.max_rays)
        return std::nullopt;
    return *asked_.max_rays - std::min(work_.rays(), *asked_.max_rays);
}

std::optional<double> Gatherer::seconds_left() const {
    if (!asked_.seconds)
        return std::nullopt;
    return std::max(*asked_.seconds - started_.seconds(), 0.0);
}

double Gatherer::error_at(double level, double TargetLevel::*of,
                          const std::optional<WholeLight>& whole) const {
    if (!whole)
        return asked_.error;
    const double most = std::max(asked_.error, whole->own_error);
    return level > 0 ? std::clamp(whole->error * whole->level.*of / level, asked_.error, most)
                     : most;
}

ReadError Gatherer::learn(const GatherTarget::Parts& parts,
                          const std::optional<WholeLight>& whole) {
    const double first = error_at(0, &TargetLevel::read, whole);
    const ReadError found = learn_to(first, parts, parts.seed);
    const double then = error_at(found.level, &TargetLevel::read, whole);
    return then < first ? learn_to(then, parts, hash_words({parts.seed})) : found;
}

ReadError Gatherer::learn_to(double error, const GatherTarget::Parts& parts, std::uint64_t seed) {
    LearnOptions options{.seed = seed, .error = share_of_read * error, .accuracy = asked_.accuracy};
    options.max_rays = rays_left().value_or(options.max_rays);
    options.seconds = parts.seconds;
    options.share = &share_;
    share_ = 0;
    const auto stage = watcher_.begin("learning the light", &share_);
    const Stopwatch watch;
    const ReadError found = cache_.learn(parts.parts, options, workers_, monitor_.interrupted);
    work_.rays_learn += found.rays;
    work_.seconds_learn += watch.seconds();
    return found;
}

Gatherer::Gathered Gatherer::gather(GatherTarget& target, const std::optional<WholeLight>& whole) {
    const Work before = work_;
    const ReadError read = learn(target.parts(workers_), whole);
    Rounds rounds(*this, target, read, whole);
    const GatherErrors errors = rounds.take();
    return {errors, {read.level, rounds.level()}, work_ - before};
}

} // namespace hemilux
