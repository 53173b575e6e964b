#pragma once
// The one way to solve a problem: a method takes steps until a rule ends the run. The program,
// `compare`, the division of patches and Python's module all take their steps here.
//
//     Run run = solve(problem, choices, monitor, watcher);    // begin(), then go_on()

#include "radiosity/answers/asked/watcher.h"
#include "radiosity/answers/run/problem.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace hemilux {

/// The memory that a run has, and who shares it.
struct MemoryShare {
    std::optional<std::uint64_t> limit; ///< of the process [bytes]; empty: a usual amount
    double needed = 0;                  ///< by all else, without what solvers keep [bytes]
    std::size_t solvers = 1;            ///< side by side
};
/// Returns the bytes that each solver may fill step by step: what `needed` leaves, and at most half
/// of the limit.
[[nodiscard]] std::uint64_t memory_of_solver(const MemoryShare& share);

/// What is chosen of a run.
struct RunChoices {
    const Method* method = nullptr;
    bool plain = false;        ///< the method's page (Method::plain) instead of the engine
    SolveOptions options = {}; ///< rays of a step as asked; without their stop and memory
    StopRule stop = {};        ///< as asked; the method's own stands in for an empty one
    /// The error of sampling at which a run ends that is not ended by steps or time alone, in place
    /// of that of `stop`: where the asked error is of something else than patches' means.
    std::optional<double> sampling = {};
    bool until_useful = false; ///< RunWatcher::is_useful() ends it as well
    MemoryShare memory = {};

    [[nodiscard]] MethodWork work() const { return method->work_with(options); }
};

/// Returns the number of rays at which a run to an error ends at the latest, if nothing else ends
/// it.
[[nodiscard]] std::uint64_t default_max_rays(std::size_t patches);

/// Returns when a run on so many patches ends.
[[nodiscard]] StopRule stop_rule(const RunChoices& choices, std::size_t patches);

/// Follows a run.
class RunWatcher : public Watcher {
  public:
    /// Sees each new solution.
    virtual void step_done(const StepRecord& /*record*/, const Solution& /*solution*/) {}
    /// Says whether the solution is good enough for what the caller has in mind.
    [[nodiscard]] virtual bool is_useful(const Solution& /*solution*/) { return false; }
};

/// A solver at work, with all that it refers to but the monitor, which outlives it.
struct Run {
    std::shared_ptr<const Problem> problem;
    std::unique_ptr<const SolveOptions> options;
    std::unique_ptr<Solver> solver;
    Monitor* monitor;
    std::vector<StepRecord> steps = {};
    /// What counts for the stop rule and the records of later steps.
    Before before = {};
    double seconds = 0;     ///< of making the solver and of its steps [s]
    bool completed = false; ///< by a rule; else it was interrupted

    [[nodiscard]] const Solution& solution() const { return solver->solution(); }
    [[nodiscard]] const Mesh& mesh() const { return *problem->mesh; }
    [[nodiscard]] SolverInput input() const {
        return {*problem->mesh, *problem->tracer, *options,
                *monitor,       problem->needs,   problem->weights};
    }
    /// Lets time that went before count for the stop rule and all records [s].
    void add_time_before(double more);
};

/// Makes the solver; its options are those of the choices with rays of a step, end and memory.
/// Throws SolveError.
[[nodiscard]] Run begin(std::shared_ptr<const Problem> problem, const RunChoices& choices,
                        Monitor& monitor);
/// Makes a solver with these very options.
[[nodiscard]] Run begin(std::shared_ptr<const Problem> problem, const Method& method,
                        SolveOptions options, bool plain, Monitor& monitor);
/// Takes a single step, which is cut short after so many seconds. Returns false where it was, or
/// interrupted; Run::steps has its record. Throws SolveError.
bool take_step(Run& run, std::optional<double> seconds);
/// Takes steps until the rule or the monitor ends the run. Throws SolveError where a step cannot be
/// done; the run is then that of the steps before.
void go_on(Run& run, const StopRule& stop, RunWatcher& watcher);
/// Does both, by stop_rule().
[[nodiscard]] Run solve(std::shared_ptr<const Problem> problem, const RunChoices& choices,
                        Monitor& monitor, RunWatcher& watcher);

} // namespace hemilux
