#include "app/gathering/gather_rounds.h"

#include "app/division/whole_error.h"
#include "app/gathering/learn_options.h"
#include "app/terminal/log.h"
#include "app/terminal/stage.h"
#include "geometry/elementary.h"
#include "io/files/error.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// The share of the error that what gathers read may leave.
constexpr double share_of_read = .7;

/// Returns the rays at a point of a picture for an error: 16 for 2 %, and as the inverse square of
/// the error, by powers of two from 4 to 64.
unsigned rays_for(double error) {
    return 1u << static_cast<unsigned>(
               std::clamp(std::round(4 + 2 * elementary::log2(.02 / error)), 2.0, 6.0));
}

/// Returns about how many rays at a point it takes in all, of which so many left this noise beside
/// the error of what they read. They double from round to round.
double rays_needed(const GatherErrors& errors, double asked, double most) {
    const double read = errors.read.error, left = asked * asked - read * read;
    const double excess = left > 0 ? errors.noise * errors.noise / left : 1;
    return std::min(
        errors.rays * elementary::exp2(std::ceil(elementary::log2(std::max(excess, 2.0)))), most);
}

/// Makes the first the mean of both.
void average(Image& light, const Image& other) {
    for (std::size_t k = 0; k < light.pixels.size(); ++k)
        light.pixels[k] = 0.5f * (light.pixels[k] + other.pixels[k]);
}

} // namespace

GatherRounds::GatherRounds(const SolveSettings& settings, const Solution& solution,
                           LightCache& cache, Monitor& monitor, Statistics& statistics,
                           const std::optional<WholeLight>& whole)
    : settings_(settings), solution_(solution), cache_(cache), monitor_(monitor),
      statistics_(statistics), whole_(whole), workers_(settings.options.threads),
      error_(error_of_gathered(settings)) {}

double GatherRounds::error_at(double level, double TargetLevel::*of) const {
    if (!whole_)
        return error_;
    const double most = std::max(error_, whole_->own_error);
    const std::size_t target = levels_.size();
    if (!(level > 0) || target >= whole_->levels.size())
        return most;
    return std::clamp(whole_->error * whole_->levels[target].*of / level, error_, most);
}

ReadError GatherRounds::learn(std::span<const TargetPart> target, std::uint64_t seed,
                              std::optional<double> seconds) {
    const double first = error_at(0, &TargetLevel::read);
    ReadError found = learn_to(first, target, seed, seconds);
    if (const double then = error_at(found.level, &TargetLevel::read); then < first)
        found = learn_to(then, target, hash_words({seed}), seconds);
    return found;
}

ReadError GatherRounds::learn_to(double error, std::span<const TargetPart> target,
                                 std::uint64_t seed, std::optional<double> seconds) {
    LearnOptions options =
        learn_options(settings_, share_of_read * error, seed, solution_, statistics_);
    options.seconds = seconds;
    share_ = 0;
    options.share = &share_;
    const Stage stage("learning the light", settings_.verbosity, share_);
    const Stopwatch watch;
    const ReadError found = cache_.learn(target, options, workers_, monitor_.interrupted);
    statistics_.rays_learn += found.rays;
    statistics_.seconds_learn += watch.seconds();
    return found;
}

GatherErrors GatherRounds::gather(const std::string& what, const ReadError& read, Image& shown,
                                  const Gather& gather, PictureJudge judge) {
    constexpr unsigned max_rays = 256;
    constexpr std::uint64_t usual_pixels = 512, max_more = 64;
    constexpr double helps = .85;
    GatherErrors errors{read};
    std::uint64_t judged = 1; // by so many times the usual pixels
    double asked = error_at(0, &TargetLevel::shown), level = 0;
    const auto judge_by = [&](std::uint64_t more) {
        judged = more;
        share_ = 0;
        const Stage stage("judging the " + what, settings_.verbosity, share_);
        const Stopwatch watch;
        const std::optional<PictureError> own =
            judge.error_of(shown, usual_pixels * more, workers_, [this](double share) {
                share_ = share;
                return !monitor_.interrupted;
            });
        statistics_.seconds_learn += watch.seconds();
        if (!own)
            return;
        statistics_.rays_learn += own->rays;
        errors.noise = own->error;
        errors.noise_uncertainty = own->uncertainty;
        errors.noise_bound = own->bound;
        errors.noise_local = own->local;
        level = own->level;
        asked = error_at(level, &TargetLevel::shown);
    };
    double before = std::numeric_limits<double>::infinity();
    bool alone = false;
    unsigned rays = settings_.gather.value_or(rays_for(asked)); // of the next round
    double needed = rays;
    for (unsigned round = 0;; ++round) {
        try {
            const double done = round == 0 ? 0 : errors.rays, all = std::max(needed, done + rays);
            share_ = done / all;
            const Stage stage("gathering the " + what, settings_.verbosity, share_);
            const Stopwatch watch;
            Image light = gather(
                {rays, round, alone, [&](double share) { share_ = (done + share * rays) / all; }});
            errors.rays = rays;
            if (round % 2 == 1) {
                average(light, shown);
                errors.rays *= 2;
            }
            shown = std::move(light);
            statistics_.seconds_gather += watch.seconds();
        } catch (const Interrupted&) {
            if (round == 0)
                throw;
            break; // the rounds before it are given out
        }
        judge_by(1);
        // Few pixels may happen to hold much: more of them cost less than to gather again, the more
        // so by more rays.
        const std::uint64_t many = round == 0 ? 16 : max_more;
        for (std::uint64_t more = 4; more <= many && !whole_ && errors.is_in_doubt(asked);
             more *= 4)
            judge_by(more);
        if (errors.is_unknown())
            break;
        log_line(settings_.verbosity, Verbosity::verbose,
                 what + " by " + counted(errors.rays, "ray", "rays") +
                     " a point: its own error is " + percent(errors.noise) +
                     ", that of the light which it reads " + percent(errors.read.error));
        if (settings_.gather || (whole_ ? errors.whole() : errors.bound()) <= asked ||
            2 * errors.rays > max_rays || !(errors.read.bound <= asked) || monitor_.interrupted)
            break;
        if (errors.noise > helps * before && std::exchange(alone, true))
            break;
        before = errors.noise;
        needed = rays_needed(errors, asked, max_rays);
        rays = round % 2 == 0 ? errors.rays : 2 * errors.rays;
    }
    const double accuracy = settings_.error_accuracy;
    for (std::uint64_t more = 4 * judged;
         accuracy > 0 && more <= max_more && !monitor_.interrupted &&
         errors.noise * errors.noise_uncertainty > accuracy * errors.whole() * errors.whole();
         more *= 4)
        judge_by(more);
    end_target({read.level, level});
    return errors;
}

} // namespace hemilux
