#pragma once
// What is asked of the light that an answer gives, and what comes with every answer: how far off it
// is, and what it took.

#include <cstdint>
#include <limits>
#include <optional>

namespace hemilux {

/// What is asked of an answer. It ends at the first limit that is met.
struct Asked {
    double error = .02; ///< relative to the light of the answer: RMS over its places [-]
    /// One sigma of the reported error, as a share of it, to which it is found out; 0: no matter.
    double accuracy = 0;
    std::optional<unsigned> rays = {}; ///< at each place, in place of what the error takes
    std::uint64_t seed = 1;
    unsigned threads = 0; ///< 0: one per core; no answer depends on their number
    std::optional<std::uint64_t> max_rays = {}; ///< of all work for the answer
    std::optional<double> seconds = {};         ///< [s]
};

/// The error of an answer, relative to its light [-]. Not a number where it is not known.
struct AnswerError {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    double whole = unknown;       ///< estimate of the RMS over places and channels
    double bound = unknown;       ///< the error is below it in 19 of 20 runs
    double uncertainty = unknown; ///< one sigma of `whole`
    double local = unknown;       ///< what 95 of 100 places are within, relative to the light there
};

/// What an answer took.
struct Work {
    std::uint64_t rays_learn = 0;  ///< to learn and to judge the light that gathers read
    std::uint64_t rays_gather = 0; ///< to gather it
    double seconds_learn = 0, seconds_gather = 0; ///< of the clock [s]

    Work& operator+=(const Work& other) {
        rays_learn += other.rays_learn;
        rays_gather += other.rays_gather;
        seconds_learn += other.seconds_learn;
        seconds_gather += other.seconds_gather;
        return *this;
    }
    [[nodiscard]] friend Work operator-(const Work& all, const Work& before) {
        return {all.rays_learn - before.rays_learn, all.rays_gather - before.rays_gather,
                all.seconds_learn - before.seconds_learn,
                all.seconds_gather - before.seconds_gather};
    }
    [[nodiscard]] std::uint64_t rays() const { return rays_learn + rays_gather; }
};

template <class Value>
struct Answer {
    Value value{};
    AnswerError error;
    Work work;
};

} // namespace hemilux
