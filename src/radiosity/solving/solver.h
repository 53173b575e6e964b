#pragma once
// What the program and the tests know of a method: its name, and that it takes steps, each of which
// improves the solution.

#include "bvh/tracer.h"
#include "parallel/ranks.h"
#include "radiosity/scene/needs.h"
#include "radiosity/solution/solution.h"
#include "radiosity/solving/stop_flag.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace hemilux {

class Mesh;

/// What the method `progressive` may do besides.
struct ProgressiveOptions {
    /// Adds to the solution shown an estimate of the light that is still unshot (Cohen et al.
    /// 1988). It makes early pictures brighter and is gone at the end.
    bool ambient = false;
    /// Patches also shoot what they will probably receive later, and take back what was too much
    /// (Feda and Purgathofer 1992). Fewer shots in bright rooms.
    bool overshoot = false;
};

/// How form factors are found.
enum class FactorKind {
    rays,    ///< by chance
    exact,   ///< without chance where patches see each other fully; for small scenes
    hemicube ///< by the pixels of a hemicube over each patch (Cohen and Greenberg 1985)
};

struct FactorOptions {
    FactorKind kind = FactorKind::rays;
    /// Pixels along an edge of the hemicube's top, even, 2 to 1024. Twice as many: rays and time
    /// are fourfold; what is smaller than a pixel is missed or counts too much.
    std::uint32_t hemicube_edge = 64;
};

/// What the user of the technique of 1997 gives (paper section 4). Each step makes four times as
/// many spherical triangles, of which a patch may have 16384 at most: parts times
/// 4^(1 + stored_steps + estimated_steps).
struct Subdivision1997Options {
    std::uint32_t stored_steps = 2; ///< n, 0 to 5: of counted surfaces; each takes rays and memory
    std::uint32_t estimated_steps = 1; ///< m, 0 to 6: of estimated ones
    /// Fictive parts of a patch, each with a hemisphere of its own: 1, 4, 16 or 64.
    std::uint32_t parts = 4;
};

/// What `hemisphere` is guided by.
enum class Guide {
    density, ///< surfaces along a ray, as in the paper
    pyramid, ///< patches in the pyramid of a triangle of directions
    visible, ///< what is visible: rho^2 / A of the nearest patch
    learned  ///< the same, from the hits of the steps before
};

struct SolveOptions {
    /// Mean energy rays per patch and step, N_hemi of the paper. More: fewer, longer steps.
    double rays = 64;
    /// Levels of subdivision of the hemisphere, 0 to 5: 4, 20, 84, ... triangles.
    int depth = 2;
    /// A triangle whose mean density [surfaces per ray] is higher is divided.
    double threshold = 0;
    /// The rules as printed in the paper; biased (docs/decisions.md, D1, D2, D10).
    bool literal = false;
    FactorOptions factors = {}; ///< of those methods that take them (Method::factors)
    ProgressiveOptions progressive = {};
    /// `progressive`, `monte-carlo`: a step is one shot, and the run ends when all light is shot;
    /// else a step has as many shots as use up its rays, or is a whole solution.
    bool one_shot = false;
    Subdivision1997Options subdivision_1997 = {};
    Guide guide = Guide::density; ///< `hemisphere`; not with `literal`
    std::uint64_t seed = 1;
    /// `stored-transport`: each step takes as many rays as all before, or as `aim` asks for; else
    /// each takes `rays`, as with the other methods.
    bool growing_steps = true;
    /// The estimated error at which the run is to end; 0: none. `stored-transport` plans its steps
    /// by it.
    double aim = 0;
    /// Steps that the caller will take, as far as it knows: methods whose steps are independent
    /// work out several at the same time. The result does not depend on it.
    std::uint32_t expected_steps = 0;
    /// Bytes that `stored-transport` may use for its rays; 0: as many as it needs.
    std::uint64_t memory = 0;
    /// 0: one per core. The result does not depend on it.
    unsigned threads = 0;
    /// Leaves out nothing that the scene does not need (needs.h): for comparison.
    bool keep_all = false;
};

/// The first that is met ends the run. With none given, `default_steps`.
struct StopRule {
    std::optional<std::uint32_t> steps;
    std::optional<double> seconds;
    std::optional<double> error; ///< estimated relative error [-], e.g. 0.01
    /// Rays in all, after which no further step is begun: where light is rare an error may be out
    /// of reach.
    std::optional<std::uint64_t> rays = {};
    static constexpr std::uint32_t default_steps = 16;
};

/// SolveOptions::expected_steps for this rule: more than will be taken where the time ends the run.
[[nodiscard]] inline std::uint32_t expected_steps(const StopRule& stop) {
    return stop.steps.value_or(stop.seconds ? std::numeric_limits<std::uint32_t>::max() : 0);
}

/// How a caller watches a run and ends it early. All members may be used from any thread.
struct Monitor {
    std::atomic<std::uint64_t> rays{0};         ///< traced so far, density rays included
    StopFlag interrupted;                       ///< set by the caller: stop as soon as possible
    std::atomic<double> step_share{0};          ///< how much of the present step is done, 0 to 1
    std::atomic<const char*> phase{"starting"}; ///< a word for the progress bar
};

class StateWriter;
class StateReader;

class Solver {
  public:
    virtual ~Solver() = default;
    /// Improves the solution. False when interrupted: the solution is then that of the steps
    /// before.
    virtual bool step() = 0;
    /// From now on steps are planned for this error, in place of SolveOptions::aim.
    virtual void aim_at(double /*error*/) {}
    [[nodiscard]] virtual const Solution& solution() const = 0;
    /// The next ones that are worked out already: they cost no time.
    [[nodiscard]] virtual std::uint32_t steps_ready() const { return 0; }
    /// The solver's own stop, e.g. nothing is left to shoot.
    [[nodiscard]] virtual bool finished() const { return false; }

    /// Between two steps: all that the next ones depend on and that a new solver of the same scene
    /// and options would not find again by itself. Only where Method::can_resume() holds; else
    /// std::logic_error.
    virtual void save(StateWriter& state) const;
    /// Of a new solver: goes on where the saved one was. Throws StateError for what save() cannot
    /// have written; the solver is then of no use.
    virtual void load(StateReader& state);
};

/// What a solver works on; all of it outlives the solver.
struct SolverInput {
    const Mesh& mesh;
    const Tracer& tracer;
    const SolveOptions& options;
    Monitor& monitor;
    const Needs& needs = everything_needed; ///< of this mesh: what is not needed may be left out
    /// By patch: Solution::weight, for methods that take one (Method::aims). Empty: 1 everywhere.
    std::span<const double> target = {};
    /// Those that solve it together, which the monitor's flag is one of (StopFlag::share). The
    /// solution does not depend on their number.
    const Ranks& ranks = one_rank();
};

class Strategy;
class Hemisphere;
class Workers;
/// How a stepwise shooting method makes its strategy (strategy.h).
using MakeStrategy = std::unique_ptr<Strategy> (*)(const SolverInput&, const Hemisphere&,
                                                   const Workers&);

/// Work of a method that a scene may not need, and what comes of it.
struct MethodWork {
    bool densities = false;      ///< counts surfaces before it solves
    bool pairs = false;          ///< looks from patches to patches
    bool linear_systems = false; ///< solves one for each channel
    bool passes = false;         ///< solves again and again, to take the mean or with more rays
    bool estimates_error = true; ///< else a run ends by itself, and how far off it is is not known
};

/// An option that few methods take: a flag.
struct MethodFlag {
    std::string_view name;         ///< as `--one-shot`
    std::string_view help;         ///< one line for --help
    bool& (*value)(SolveOptions&); ///< what it sets
};

/// The flag of methods whose light comes shot by shot.
inline constexpr MethodFlag one_shot_flag{
    "--one-shot", "progressive, monte-carlo: a step is one shot",
    [](SolveOptions& options) -> bool& { return options.one_shot; }};

/// An option that few methods take: one of some whole numbers.
struct MethodNumber {
    std::string_view name;                  ///< as `--parts`
    std::string_view help;                  ///< one line for --help
    std::span<const std::uint32_t> choices; ///< ascending
    std::uint32_t& (*value)(SolveOptions&); ///< what it sets
};

/// What the program takes a method for where the user names none. Each role is one method's.
enum class Role {
    standard,   ///< solves
    reference,  ///< is taken for the truth in comparisons
    baseline,   ///< the others' gains are relative to it
    paper,      ///< shows how hemispheres are divided
    forerunner, ///< shows how they were divided before
};

/// A method as the user picks it.
struct Method {
    std::string_view name;    ///< of --method
    std::string_view summary; ///< one line for --help, with the source
    bool has_literal = false; ///< --literal changes it
    bool unbiased;            ///< each step, in its corrected form; else consistent
    StopRule default_stop;    ///< where the user gives none
    std::unique_ptr<Solver> (*make)(const SolverInput&);
    MakeStrategy strategy = nullptr; ///< what it shoots with; nullptr if it is no shooting method
    MethodWork work = {};            ///< what it does that a scene may not need
    bool saves = false;              ///< save and load are there; all shooting methods have them
    /// The same on one page, slow and obviously right (plain/plain.h); nullptr where there is none.
    std::unique_ptr<Solver> (*plain)(const SolverInput&) = nullptr;
    std::size_t most_plain_patches = std::numeric_limits<std::size_t>::max(); ///< of its page
    std::optional<Role> role = {};
    bool guided = false; ///< --guide changes it
    bool aims = false;   ///< --for changes it
    std::span<const MethodFlag> flags = {};
    std::span<const MethodNumber> numbers = {};
    /// Throws std::invalid_argument with what is wrong where numbers do not go together.
    void (*check)(const SolveOptions&) = nullptr;
    /// Kinds of form factors that it may solve with besides its own.
    std::span<const FactorKind> factors = {};
    /// Options that make it the one to solve with where --method is not given.
    std::span<const std::string_view> implied_by = {};
    std::string_view former_name = {}; ///< what --method takes too; empty where there is none

    [[nodiscard]] bool can_resume() const { return saves || strategy; }
    /// What it does with these options. Hemicubes look from all patches whatever the scene needs,
    /// once, and what lies between their pixels is not random.
    [[nodiscard]] MethodWork work_with(const SolveOptions& options) const {
        MethodWork done = work;
        if (options.factors.kind == FactorKind::hemicube) {
            done.pairs = done.passes = false;
            done.estimates_error = false;
        }
        return done;
    }
};

/// All methods, one per file of strategies/ and solvers/, in alphabetical order.
[[nodiscard]] std::span<const Method* const> methods();
/// Finds it by its name or its former name; nullptr if there is no such method.
[[nodiscard]] const Method* find_method(std::string_view name);
/// The one that has this role.
[[nodiscard]] const Method& method_of(Role role);

/// A row of the steps log.
struct StepRecord {
    std::uint32_t step;
    std::uint64_t rays; ///< every ray so far
    double seconds;     ///< since the solver was made
    double estimated_error;
};

/// What a resumed run did before, which counts for the stop rule and the records.
struct Before {
    std::uint32_t steps = 0;
    double seconds = 0; ///< but for those of Solution::seconds_density
};

/// Steps until the rule or the monitor ends the run; then still those that are ready. `after_step`
/// sees each new solution. Returns false when interrupted. At the end of
/// `stop.seconds`, or of one second where that is later, a step is cut short: if it is the first
/// there may be no step at all.
bool run(Solver& solver, const SolverInput& input, const StopRule& stop,
         const std::function<void(const StepRecord&, const Solution&)>& after_step = {},
         const Before& before = {});

} // namespace hemilux
