#pragma once
// How well the errors that a method reports fit the true ones: many runs of a hard scene, judged
// one by one and together.

#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/paper/scene/needs.h"
#include "radiosity/paper/solution/solution.h"
#include "support/families/hard_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux::test {

/// When a run is given up: it counts with what it has reached.
struct RunLimits {
    double seconds = 60;
    std::uint64_t rays = 2'000'000'000;
};

/// The mesh and the tracer of a hard scene, made as the program does.
class PreparedScene {
  public:
    explicit PreparedScene(const HardScene& hard);
    [[nodiscard]] const HardScene& hard() const { return hard_; }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const Tracer& tracer() const { return *made_.tracer; }
    [[nodiscard]] const Needs& needs() const { return needs_; }

  private:
    const HardScene& hard_;
    Mesh mesh_;
    Needs needs_;
    MadeTracer made_;
};

/// Of values whose standard error is above 0, how many there are and how many lie within it.
struct Coverage {
    std::size_t count = 0, within_2 = 0, within_3 = 0;
    void add(double score);
    void add(const Coverage& other);
};

/// A reported error that is larger by this factor still counts as right.
inline constexpr double wrong_factor = 1.5;
/// A part's mean may be off by so many of its reported standard errors.
inline constexpr double part_errors = 3;

struct JudgedRun {
    double true_error = 0;     ///< true_error() of solution.h
    double reported = 0;       ///< estimated_error()
    bool unknown = false;      ///< the reported one is NaN or infinite, or there was no step
    bool wrong = false;        ///< the true error is more than wrong_factor times the reported one
    bool part_wrong = false;   ///< a part's mean is off by more than part_errors
    bool part_unknown = false; ///< a standard error in a part is NaN
    double bias = 0;           ///< of the reflected power, relative
    Coverage often, seldom;    ///< values of patches with 30 hits, and of those with fewer
    std::uint64_t rays = 0;
    double seconds = 0;
    bool stopped = false; ///< by the limits
    bool refused = false; ///< the method threw SolveError
};

/// `stop` empty: the method's own.
[[nodiscard]] StopRule stop_rule(const Method& method, std::optional<double> error);
[[nodiscard]] JudgedRun judge_run(const PreparedScene& scene, const Method& method,
                                  const StopRule& stop, std::uint64_t seed, unsigned threads,
                                  const RunLimits& limits);
/// A finished solution; the part of judge_run that does not run anything.
[[nodiscard]] JudgedRun judge(const PreparedScene& scene, const Solution& solution);

/// A row of the table.
struct Reliability {
    std::size_t runs = 0, wrong = 0, unknown = 0, parts_wrong = 0, parts_unknown = 0, stopped = 0,
                refused = 0;
    Coverage often, seldom;
    double median_true = 0, median_reported = 0, rms_ratio = 0; ///< true over reported
    double bias = 0;                                            ///< mean, relative
    double median_rays = 0, median_seconds = 0;
};
[[nodiscard]] Reliability summary(const std::vector<JudgedRun>& runs);

} // namespace hemilux::test
