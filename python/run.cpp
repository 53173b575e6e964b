#include "python/run.h"

#include "app/division/whole_error.h"
#include "app/loading/load.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "radiosity/answers/run/lost_light.h"
#include "radiosity/answers/run/run_findings.h"
#include "radiosity/answers/run/unknown_groups.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/paper/hemisphere/hemisphere.h"

namespace hemilux {
namespace {

template <class Number>
void check(const char* name, const std::optional<Number>& number, const NumberRange& range) {
    if (number && !range.contains(static_cast<double>(*number)))
        throw UsageError(std::string(name) + ": expected a number " + range.text());
}

void check(const RunNumbers& numbers) {
    constexpr NumberRange from_one{.low = 1, .high = no_limit};
    check("error", numbers.error, positive);
    check("seconds", numbers.seconds, positive);
    check("rays", numbers.rays, positive);
    check("steps", numbers.steps, from_one);
    check("max_rays", numbers.max_rays, from_one);
    check("threshold", std::optional(numbers.threshold), non_negative);
    check("depth", std::optional(numbers.depth),
          {.low = 0, .high = static_cast<double>(Hemisphere::max_depth)});
}

/// Sets the options that belong to the method.
void set_own_options(const Method& method, const RunNumbers& numbers, SolveOptions& options) {
    const std::vector<MethodOption> known = method.own_options();
    for (const auto& [name, value] : numbers.own) {
        const auto option = std::ranges::find(known, name, &MethodOption::name);
        if (option == known.end()) {
            std::vector<std::string> names;
            for (const MethodOption& of_method : known)
                names.push_back(of_method.name);
            throw UsageError(std::string(method.name) + " has no option " + name +
                             (names.empty() ? "" : "; it has " + joined(names, ", ")));
        }
        if (!option->set(options, value))
            throw UsageError(
                name + ": expected " +
                (option->values.empty() ? "True or False" : joined(option->values, ", ", " or ")) +
                ", found '" + value + "'");
    }
}

/// Finds the true error of each step, where there is a reference.
class ErrorWatcher : public RunWatcher {
  public:
    ErrorWatcher(const Mesh& mesh, std::span<const Vec3> reference)
        : mesh_(mesh), reference_(reference) {}
    void step_done(const StepRecord& /*record*/, const Solution& solution) override {
        if (!reference_.empty())
            errors.push_back(true_error(mesh_, solution.radiosity, reference_).all);
    }
    std::vector<double> errors;

  private:
    const Mesh& mesh_;
    std::span<const Vec3> reference_;
};

/// Returns what there is to say of a run and its light.
Findings findings_of(const Run& run, const RunChoices& choices) {
    const Solution& solution = run.solution();
    Findings findings =
        run_findings(run.steps, {.stop = stop_rule(choices, run.mesh().patches().size()),
                                 .estimates_error = choices.work().estimates_error,
                                 .error = estimated_error(run.mesh(), solution),
                                 .interrupted = !run.completed});
    add(findings, unknown_groups_finding(run.mesh(), solution));
    add(findings, lost_light_finding(run.mesh(), *run.problem->tracer, solution, Sides::front));
    return findings;
}

} // namespace

const Method& method_named(const std::string& name) {
    if (const Method* const method = find_method(name))
        return *method;
    std::vector<std::string> names;
    for (const Method* const method : methods())
        names.emplace_back(method->name);
    throw UsageError(unknown_name("method", name, names));
}

SolveSettings settings_of(const Method& method, const RunNumbers& numbers) {
    check(numbers);
    SolveSettings settings;
    settings.method = &method;
    SolveOptions& options = settings.options;
    options.rays = numbers.rays.value_or(options.rays);
    options.depth = numbers.depth;
    options.threshold = numbers.threshold;
    options.literal = numbers.literal;
    options.keep_all = numbers.keep_all;
    options.seed = numbers.seed;
    options.threads = numbers.threads;
    if (numbers.literal && !method.has_literal)
        throw UsageError("literal: " + std::string(method.name) + " has no printed rules");
    set_own_options(method, numbers, options);
    check_own_options(options, {&settings.method, 1});
    settings.stop = {.steps = numbers.steps,
                     .seconds = numbers.seconds,
                     .error = numbers.error,
                     .rays = numbers.max_rays};
    return settings;
}

RunResult run_method(const PythonMesh& mesh, const SolveSettings& settings,
                     std::span<const Vec3> reference, Monitor& monitor) {
    mesh.check_solvable();
    check_own_options(settings.options, {&settings.method, 1}, mesh.mesh().patches().size());
    const std::shared_ptr<const Problem> problem =
        mesh.problem(settings.options.keep_all, settings.options.threads);
    ErrorWatcher watcher(mesh.mesh(), reference);
    const RunChoices choices = run_choices(settings);
    try {
        RunResult result{solve(problem, choices, monitor, watcher), {}, {}};
        result.true_errors = std::move(watcher.errors);
        result.findings = findings_of(result.run, choices);
        return result;
    } catch (const SolveError& error) {
        throw as_input_error(error, mesh.name(), mesh.face_lines());
    }
}

} // namespace hemilux
