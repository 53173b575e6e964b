#pragma once
// Light that is gathered, judged, and gathered once more until its error is as asked for: that of
// pictures and lightmaps, one target after the other.

#include "app/settings/settings.h"
#include "geometry/elementary.h"
#include "io/results/statistics.h"
#include "parallel/workers.h"
#include "radiosity/answers/pictures/picture_error.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/paper/solving/solver.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// How bright a target is: RMS over its places and channels [W/m2].
struct TargetLevel {
    double read = 0;  ///< light that gathers there read
    double shown = 0; ///< light that a picture or lightmap shows
};

/// The whole light of which only a part is gathered.
struct WholeLight {
    std::span<const TargetLevel> levels; ///< GatheredLight::levels
    double error;     ///< that the part may have, relative to the whole light of a target [-]
    double own_error; ///< that it may have at most, relative to its own light [-]
};

/// The errors of what is given out.
struct GatherErrors {
    ReadError read;                                          ///< of the light that gathers read
    double noise = std::numeric_limits<double>::quiet_NaN(); ///< of their own, relative [-]
    double noise_uncertainty = 0;                            ///< one sigma
    double noise_bound = 0;                                  ///< what it surely is at most
    double noise_local = 0; ///< what 95 of 100 places are within, relative to their light [-]
    unsigned rays = 0;      ///< at a point, of the last gather

    /// Returns whether a signal came before the light was judged.
    [[nodiscard]] bool is_unknown() const { return std::isnan(noise); }
    [[nodiscard]] double whole() const { return elementary::hypot(read.error, noise); }
    [[nodiscard]] double bound() const { return elementary::hypot(read.bound, noise_bound); }
    [[nodiscard]] double local() const { return elementary::hypot(read.local, noise_local); }
    /// Returns whether the error may be larger or smaller than this one.
    [[nodiscard]] bool is_in_doubt(double limit) const {
        return bound() > limit && whole() - 2 * uncertainty() <= limit;
    }
    [[nodiscard]] double uncertainty() const {
        return whole() > 0
                   ? elementary::hypot(read.error * read.uncertainty, noise * noise_uncertainty) /
                         whole()
                   : elementary::hypot(read.uncertainty, noise_uncertainty);
    }
};

class GatherRounds {
  public:
    /// All of it outlives this. With `whole`, the light is a part of what that is known of.
    GatherRounds(const SolveSettings& settings, const Solution& solution, LightCache& cache,
                 Monitor& monitor, Statistics& statistics, const std::optional<WholeLight>& whole);

    /// Learns the light of the next target. How bright a part of the light is there shows itself.
    [[nodiscard]] ReadError learn(std::span<const TargetPart> target, std::uint64_t seed,
                                  std::optional<double> seconds = {});

    /// A round of rays of its own.
    struct Round {
        unsigned rays;   ///< at a point
        unsigned number; ///< from 0
        bool alone;      ///< each place at which light changes fast gathers by itself
        std::function<void(double share)> tell; ///< to be called with the share that is done
    };
    /// Returns the light of a round. Throws Interrupted where a signal came before all of it was
    /// gathered.
    using Gather = std::function<Image(const Round& round)>;
    /// Gathers by so many rays at a point, and has what was given out judged. Where the error is
    /// too large, it is gathered by as many rays once more, and the mean of both is given out; then
    /// in the same way with twice as many rays as there were. Once that does not help, it is
    /// gathered alone: then most of the error lies between the points of the grid, as in small
    /// pictures. Where the error itself is asked for, more pixels are judged. A part of the light
    /// need not be surely as exact as it may be, as its error is told. The target ends with it. A
    /// signal leaves the rounds before it; in the first one it throws Interrupted.
    GatherErrors gather(const std::string& what, const ReadError& read, Image& shown,
                        const Gather& gather, PictureJudge judge);

    /// Returns the relative error that what is read of the present target may have, by its level;
    /// 0: unknown yet.
    [[nodiscard]] double error_of_read(double level) const {
        return error_at(level, &TargetLevel::read);
    }
    void end_target(const TargetLevel& level) { levels_.push_back(level); }
    [[nodiscard]] const std::vector<TargetLevel>& levels() const { return levels_; }

  private:
    [[nodiscard]] double error_at(double level, double TargetLevel::*of) const;
    ReadError learn_to(double error, std::span<const TargetPart> target, std::uint64_t seed,
                       std::optional<double> seconds);

    const SolveSettings& settings_;
    const Solution& solution_;
    LightCache& cache_;
    Monitor& monitor_;
    Statistics& statistics_;
    const std::optional<WholeLight>& whole_;
    Workers workers_;
    double error_;                 ///< that was asked for
    std::atomic<double> share_{0}; ///< of the present work that is done
    std::vector<TargetLevel> levels_;
};

} // namespace hemilux
