#pragma once
// Light that is gathered from a solution, judged, and gathered once more until its error is as
// asked for: that of points, pictures and lightmaps, one target after the other. What was learned
// for one serves the next.

#include "geometry/elementary.h"
#include "parallel/stopwatch.h"
#include "parallel/workers.h"
#include "radiosity/answers/asked/answer.h"
#include "radiosity/answers/asked/watcher.h"
#include "radiosity/answers/gathering/gather_target.h"
#include "radiosity/answers/pictures/lit_scene.h"
#include "radiosity/light/cached_light/light_cache.h"
#include "radiosity/paper/solution/solution.h"
#include "radiosity/paper/solving/solver.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace hemilux {

/// How bright a target is: RMS over its places and channels [W/m2].
struct TargetLevel {
    double read = 0;  ///< light that gathers there read
    double shown = 0; ///< light that a picture or lightmap shows
};

/// The whole light of a target, of which only a part is gathered.
struct WholeLight {
    TargetLevel level;
    double error;     ///< that the part may have, relative to the whole light [-]
    double own_error; ///< that it may have at most, relative to its own light [-]
};

/// The errors of what is given out.
struct GatherErrors {
    ReadError read;                                          ///< of the light that gathers read
    double noise = std::numeric_limits<double>::quiet_NaN(); ///< of their own, relative [-]
    double noise_uncertainty = 0;                            ///< one sigma
    double noise_bound = 0;                                  ///< what it surely is at most
    double noise_local = 0; ///< what 95 of 100 places are within, relative to their light [-]
    unsigned rays = 0;      ///< at a place, of what is given out

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
    /// Returns them as an answer has them.
    [[nodiscard]] AnswerError of_answer() const {
        return is_unknown() ? AnswerError{} : AnswerError{whole(), bound(), uncertainty(), local()};
    }
};

class Gatherer {
  public:
    /// `scene` has the light of `solution`. Both and the monitor and the watcher live as long as
    /// the gatherer is used. `asked` holds for all targets together.
    Gatherer(const LitScene& scene, const Solution& solution, const Asked& asked, Monitor& monitor,
             Watcher& watcher);

    struct Gathered {
        GatherErrors errors;
        TargetLevel level;
        Work work;
    };
    /// Learns the light that a target sees, gathers it by so many rays at a place, and has it
    /// judged. Where the error is too large, it is gathered by as many rays once more, and the mean
    /// of both is given out; then in the same way with twice as many rays as there were. Once that
    /// does not help, it is gathered alone: then most of the error lies between the points of the
    /// grid, as in small pictures. Where the error itself is asked for, more places are judged.
    ///
    /// With `whole` the light is a part of that, and is as exact as that needs it; it need not be
    /// surely as exact as it may be, as its error is told. A signal leaves the rounds before it; in
    /// the first one it throws Interrupted.
    Gathered gather(GatherTarget& target, const std::optional<WholeLight>& whole = {});

    [[nodiscard]] const LitScene& scene() const { return scene_; }
    [[nodiscard]] const Solution& solution() const { return solution_; }
    [[nodiscard]] const LightCache& cache() const { return cache_; }
    [[nodiscard]] const Asked& asked() const { return asked_; }
    [[nodiscard]] const Workers& workers() const { return workers_; }
    [[nodiscard]] Watcher& watcher() const { return watcher_; }
    [[nodiscard]] const std::atomic<bool>& wishes_to_end() const {
        return monitor_.interrupted.own().wished;
    }
    /// Returns the seed of a use of random numbers: each has a number of its own.
    [[nodiscard]] std::uint64_t seed_of(std::uint64_t use) const;
    /// Returns the rays that the limit leaves, and the time [s]; nothing where there is none.
    [[nodiscard]] std::optional<std::uint64_t> rays_left() const;
    [[nodiscard]] std::optional<double> seconds_left() const;
    /// Returns the work so far, for all targets.
    [[nodiscard]] const Work& work() const { return work_; }

  private:
    class Rounds;
    ReadError learn(const GatherTarget::Parts& parts, const std::optional<WholeLight>& whole);
    ReadError learn_to(double error, const GatherTarget::Parts& parts, std::uint64_t seed);
    [[nodiscard]] double error_at(double level, double TargetLevel::*of,
                                  const std::optional<WholeLight>& whole) const;

    LitScene scene_;
    const Solution& solution_;
    Asked asked_;
    Monitor& monitor_;
    Watcher& watcher_;
    Workers workers_;
    LightCache cache_;
    Stopwatch started_;
    std::atomic<double> share_{0}; ///< of the present work that is done
    Work work_;
};

} // namespace hemilux
