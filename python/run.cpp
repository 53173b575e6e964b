#include "python/run.h"

#include "app/division/default_division.h"
#include "app/loading/load.h"
#include "app/memory/memory.h"
#include "app/running/step_size.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "parallel/stopwatch.h"
#include "radiosity/engine/emitters/lit_by_points.h"
#include "radiosity/engine/needs/find_needs.h"
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

std::unique_ptr<RunResult> run_method(const PythonMesh& mesh, const SolveSettings& settings,
                                      std::span<const Vec3> reference, Monitor& monitor) {
    mesh.check_solvable();
    const std::size_t patches = mesh.mesh().patches().size();
    check_own_options(settings.options, {&settings.method, 1}, patches);
    auto result = std::make_unique<RunResult>();
    SolveOptions& options = result->options = with_memory(settings.options, {}, 0);
    const StopRule stop = stop_rule(settings, patches);
    options.rays = rays_of_step(options.rays, settings.stop.seconds, *settings.method, patches);
    options.stop = stop;
    if (!options.keep_all)
        result->needs = find_needs(mesh.mesh());
    const SolverInput input{mesh.mesh(), mesh.tree(options.threads), options, monitor,
                            result->needs};
    const Stopwatch solving;
    try {
        result->solver = make_solver(*settings.method, input);
        run(*result->solver, input, stop, [&](const StepRecord& record, const Solution& solution) {
            result->steps.push_back(record);
            if (!reference.empty())
                result->true_errors.push_back(
                    true_error(mesh.mesh(), solution.radiosity, reference).all);
        });
    } catch (const SolveError& error) {
        throw as_input_error(error, mesh.name(), mesh.face_lines());
    }
    result->seconds = solving.seconds();
    return result;
}

} // namespace hemilux
