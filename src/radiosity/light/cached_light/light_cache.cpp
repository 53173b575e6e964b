#include "radiosity/light/cached_light/light_cache.h"

#include "parallel/workers.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/light/cached_light/local_error.h"
#include "radiosity/light/cached_light/walks.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/stop_flag.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace hemilux {
namespace {

/// The walks of the first round. A later round has as many as all before it, so that it may judge
/// what they found.
constexpr std::size_t first_walks = 4096;

/// The most parts of a target that take walks in a round: with fewer, the error is known sooner.
constexpr std::size_t parts_of_round = 96;

/// The number of places of a target, each of several parts, whose errors are told apart.
constexpr std::size_t places_of_target = 32;

/// The most of them where the error itself is asked for: it is known no better than parts differ.
constexpr std::size_t max_parts_to_know = 4096;

/// The least number of walks in a group: their spread is the noise of the group.
constexpr std::size_t min_of_group = 4;

/// The number of walks that are taken together.
constexpr std::size_t walks_at_a_time = 8192;

/// One in twenty errors is larger than its mean and 1.6 sigma. The first of several errors that are
/// small enough errs low, so it is some more.
constexpr double sigmas_of_bound = 2;

/// The least number of rounds: the first ones have too few walks for what is rare.
constexpr std::uint64_t min_rounds = 3;

/// Where no light is found at all, or more than numbers hold, walks end at one in so many of all
/// rays.
constexpr std::uint64_t share_of_unknown = 64;

/// What one group of walks of a part finds.
struct Group {
    Vec3 light{0.0};    ///< as gathers find it, sum [W/m2]
    Vec3 residual{0.0}; ///< sum [W/m2]
    double squares = 0; ///< of residuals, sum over channels

    void add(const WalkLight& walk, const Vec3& reflectance) {
        const Vec3 found =
            reflectance * (walk.direct + walk.read + (walk.is_near ? walk.residual : Vec3(0.0)));
        const Vec3 lacks = walk.is_near ? Vec3(0.0) : reflectance * walk.residual;
        light += found;
        residual += lacks;
        squares += glm::dot(lacks, lacks);
    }
};

/// Returns the variance of the mean of n values, summed over channels.
double variance_of_mean(const Vec3& sum, double squares, double n) {
    return std::max(squares - glm::dot(sum, sum) / n, 0.0) / (n * (n - 1));
}

} // namespace

struct LightCache::Round {
    std::vector<std::array<Group, 2>> groups; ///< by part
    std::vector<IrradianceCells::Sample> samples;
    std::uint64_t rays = 0;

    [[nodiscard]] ReadError error(std::span<const TargetPart> target, double n) const;
};

/// What the walks of some neighbouring parts find.
struct Place {
    double product = 0; ///< of both groups
    double noise = 0;   ///< variance of `product` where nothing is missing
    double light = 0;   ///< squared
};

/// Returns what 95 of 100 places are within. Where walks do not tell an error from their noise, a
/// place counts with the error of all.
double local_error(std::span<const Place> places, double mean_square) {
    constexpr double resolved = 2; // sigmas
    LocalErrors errors;
    for (const Place& place : places)
        errors.add(place.product > resolved * std::sqrt(place.noise) ? place.product
                                                                     : mean_square * place.light,
                   place.light);
    return errors.within();
}

/// Adds the products of both groups over the parts. Their spread is by the noise of the groups, or
/// as parts differ, whichever is more.
ReadError LightCache::Round::error(std::span<const TargetPart> target, double n) const {
    double products = 0, squares = 0, light = 0, by_noise = 0, weight = 0;
    const std::size_t of_place = (target.size() + places_of_target - 1) / places_of_target;
    std::vector<Place> places((target.size() + of_place - 1) / of_place);
    for (std::size_t k = 0; k < target.size(); ++k) {
        const auto& [a, b] = groups[k];
        const double w = target[k].weight;
        const double product = w * glm::dot(a.residual, b.residual) / (n * n);
        products += product;
        squares += product * product;
        const double square_light =
            w * glm::dot(a.light + a.residual, b.light + b.residual) / (n * n);
        light += square_light;
        const double va = variance_of_mean(a.residual, a.squares, n),
                     vb = variance_of_mean(b.residual, b.squares, n);
        Place& place = places[k / of_place];
        place.product += product;
        place.noise += w * w * va * vb;
        place.light += square_light;
        by_noise += w * w * va * vb + std::max(product, 0.0) * w * (va + vb);
        weight += w;
    }
    if (!(light > 0))
        return {};
    const auto parts = static_cast<double>(target.size());
    const double as_parts_differ =
        parts > 1 ? std::max(squares - products * products / parts, 0.0) * parts / (parts - 1) : 0;
    const double square = std::max(products / light, 0.0);
    const double sigma = std::sqrt(std::max(by_noise, as_parts_differ)) / light;
    const double bound = std::sqrt(square + sigmas_of_bound * sigma);
    return {.error = std::sqrt(square),
            .bound = bound,
            .uncertainty = (bound - std::sqrt(square)) / sigmas_of_bound,
            .local = local_error(places, square),
            .level = std::sqrt(light / (3 * weight))};
}

/// Calls done(walks) after some of them, on any thread.
template <class Done>
LightCache::Round LightCache::take_walks(std::span<const TargetPart> target, std::size_t of_group,
                                         std::uint64_t seed, const Workers& workers,
                                         const StopFlag& interrupted, const Done& done) {
    Round round;
    round.groups.resize(target.size());
    const Walks walks(mesh_, tracer_, light_);
    const std::size_t of_part = 2 * of_group;
    const std::size_t parts = std::max<std::size_t>(1, walks_at_a_time / of_part);
    const std::size_t chunks = (target.size() + parts - 1) / parts;
    std::vector<std::vector<IrradianceCells::Sample>> samples(chunks);
    std::vector<std::uint64_t> rays(chunks);
    workers.for_chunks(target.size(), parts, [&](std::size_t begin, std::size_t end) {
        if (interrupted)
            return;
        const std::size_t chunk = begin / parts;
        std::vector<WalkStart> starts;
        std::vector<WalkLight> found;
        for (std::size_t first = begin * of_part; first < end * of_part;) {
            const std::size_t last = std::min(first + walks_at_a_time, end * of_part);
            starts.clear();
            for (std::size_t k = first; k < last; ++k) {
                const std::size_t part = k / of_part, group = k % of_part / of_group,
                                  number = k % of_group;
                const auto& points = target[part].points;
                SobolBlocks<4> numbers(hash_words({seed, part, group}));
                const auto u = numbers.at(static_cast<std::uint32_t>(number));
                starts.push_back({points[number % points.size()],
                                  {u[0], u[1]},
                                  hash_words({seed, part, group, number})});
            }
            found.assign(starts.size(), {});
            rays[chunk] += walks.take(starts, found, samples[chunk]);
            done(starts.size());
            for (std::size_t k = first; k < last; ++k) {
                const TargetPart& part = target[k / of_part];
                round.groups[k / of_part]
                    .at(k % of_part / of_group)
                    .add(found[k - first], part.reflectance[k % of_group % part.points.size()]);
            }
            first = last;
        }
    });
    for (std::size_t k = 0; k < chunks; ++k) {
        round.rays += rays[k];
        round.samples.insert(round.samples.end(), samples[k].begin(), samples[k].end());
        samples[k] = {};
    }
    return round;
}

/// Returns parts of a target, other ones in each round: what was learned at some is judged at
/// others.
std::vector<TargetPart> some_of(std::span<const TargetPart> target, std::size_t most,
                                std::uint64_t seed) {
    const std::size_t count = std::min(target.size(), most);
    const double offset = Rng(seed).uniform();
    std::vector<TargetPart> some;
    for (std::size_t k = 0; k < count; ++k)
        some.push_back(target[static_cast<std::size_t>((double(k) + offset) *
                                                       double(target.size()) / double(count))]);
    return some;
}

/// Returns whether an error is known as well as asked for, beside other errors of half its limit.
bool is_known(const ReadError& found, const LearnOptions& options) {
    return !(options.accuracy > 0) ||
           found.error * found.uncertainty <=
               options.accuracy * (found.error * found.error + options.error * options.error / 4);
}

/// Returns about how many walks it takes in all, of which `taken` have this error: noise falls as
/// the root of their number.
double walks_needed(const ReadError& found, double taken, const LearnOptions& options) {
    constexpr double least = double(first_walks << (min_rounds - 1));
    const double excess = std::isfinite(found.bound) ? found.bound / options.error : 1;
    return std::max(least, taken * excess * excess);
}

/// Once the light is right further rounds only judge it.
ReadError LightCache::learn(std::span<const TargetPart> target, const LearnOptions& options,
                            const Workers& workers, const StopFlag& interrupted) {
    ReadError found;
    std::uint64_t rays = 0, walks = 0;
    std::size_t next = first_walks;
    bool is_right = false;
    const auto start = std::chrono::steady_clock::now();
    // A round has twice the walks of all before it.
    const auto would_end_late = [&] {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
        return options.seconds && 3 * elapsed.count() > *options.seconds;
    };
    for (std::uint64_t number = 0; !target.empty(); ++number) {
        const std::uint64_t seed = hash_words({options.seed, number});
        const std::vector<TargetPart> some =
            some_of(target, options.accuracy > 0 ? max_parts_to_know : parts_of_round, seed);
        const std::size_t of_group = std::max(min_of_group, next / (2 * some.size()));
        const double needed = walks_needed(found, double(walks), options);
        std::atomic<std::uint64_t> begun{walks};
        const Round round =
            take_walks(some, of_group, seed, workers, interrupted, [&](std::size_t more) {
                if (options.share)
                    *options.share = double(begun += more) / std::max(needed, double(begun));
            });
        if (interrupted) {
            if (number < min_rounds)
                found = {};
            break;
        }
        found = round.error(some, static_cast<double>(of_group));
        if (!is_right) {
            cells_.add(round.samples);
            cells_.update();
        }
        rays += round.rays;
        const std::size_t taken = 2 * of_group * some.size();
        walks += taken;
        is_right = is_right || (number + 1 >= min_rounds && found.bound <= options.error);
        const std::uint64_t max_rays =
            std::isfinite(found.bound) ? options.max_rays : options.max_rays / share_of_unknown;
        if ((is_right && is_known(found, options)) || 2 * rays > max_rays || would_end_late())
            break;
        next = number == 0 ? taken : 2 * taken;
    }
    found.walks = walks;
    found.rays = rays;
    return found;
}

} // namespace hemilux
