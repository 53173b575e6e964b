// compare: methods side by side against a reference, as the program's `compare` runs them.

#include "app/commands/compare_run.h"
#include "app/commands/compare_summary.h"
#include "app/settings/exit_code.h"
#include "python/parts.h"
#include "python/run.h"
#include "python/waiting.h"
#include "radiosity/paper/sampling/rng.h"

#include <pybind11/stl.h>

namespace hemilux {
namespace {

/// Returns the settings of the runs. Throws UsageError.
CompareSettings settings_of(const std::vector<std::string>& names, const RunNumbers& numbers,
                            std::uint32_t runs) {
    CompareSettings settings;
    if (names.empty())
        throw UsageError("methods: expected a name at least");
    for (const std::string& name : names) {
        const Method& method = method_named(name);
        RunNumbers of_method = numbers;
        of_method.literal = numbers.literal && method.has_literal;
        settings.options = settings_of(method, of_method).options;
        settings.variants.push_back({name, &method});
    }
    settings.options.literal = numbers.literal;
    if (numbers.max_rays)
        settings.budget.rays = static_cast<double>(*numbers.max_rays);
    settings.budget.seconds = numbers.seconds;
    settings.runs = runs;
    return settings;
}

/// Solves by the method that is the reference, with random numbers that no run has.
Reference compute_reference(const PythonMesh& mesh, const RunNumbers& numbers, double error,
                            Monitor& monitor) {
    RunNumbers of_reference;
    of_reference.error = error;
    of_reference.rays = numbers.rays;
    of_reference.depth = numbers.depth;
    of_reference.threshold = numbers.threshold;
    of_reference.threads = numbers.threads;
    of_reference.seed = hash_words({numbers.seed, 0x7265666572656e63u});
    const RunResult found =
        run_method(mesh, settings_of(method_of(Role::reference), of_reference), {}, monitor);
    const Solution& solution = found.run.solution();
    return {solution.radiosity, solution.standard_error, {}};
}

py::dict rows_of(const std::vector<StepRow>& rows) {
    const std::size_t n = rows.size();
    py::dict result;
    py::list names;
    for (const StepRow& row : rows)
        names.append(row.method);
    result["method"] = names;
    result["run"] = array_by<std::int64_t>(n, [&](std::size_t k) { return rows[k].run; });
    result["step"] = array_by<std::int64_t>(n, [&](std::size_t k) { return rows[k].record.step; });
    result["rays"] = array_by<std::uint64_t>(n, [&](std::size_t k) { return rows[k].record.rays; });
    result["seconds"] = array_by<double>(n, [&](std::size_t k) { return rows[k].record.seconds; });
    result["estimated_error"] =
        array_by<double>(n, [&](std::size_t k) { return rows[k].record.estimated_error; });
    result["true_error"] = array_by<double>(n, [&](std::size_t k) { return rows[k].error->all; });
    return result;
}

py::list summary_of(const std::vector<MethodRuns>& results, bool literal) {
    py::list table;
    for (const MethodSummary& summary : summarise(results, literal)) {
        py::dict row;
        row["method"] = summary.label;
        row["runs"] = summary.runs;
        row["rays"] = summary.rays;
        row["seconds"] = summary.seconds;
        row["true_error"] = summary.error.all;
        row["estimated_error"] = summary.estimated_error;
        row["bytes_density"] = summary.bytes_density;
        table.append(row);
    }
    return table;
}

py::tuple compare(const PythonMesh& mesh, const std::vector<std::string>& names,
                  const RunNumbers& numbers, std::uint32_t runs,
                  const std::optional<Doubles>& known, double reference_error,
                  const py::object& progress) {
    const CompareSettings settings = settings_of(names, numbers, runs);
    Reference reference;
    if (known) {
        const std::span<const Vec3> radiosity = hemilux::rows_of(*known);
        reference.radiosity.assign(radiosity.begin(), radiosity.end());
    }
    Monitor monitor;
    std::vector<MethodRuns> results;
    std::optional<SolveError> fault;
    run_without_lock(monitor, progress, [&] {
        mesh.check_solvable();
        if (!known)
            reference = compute_reference(mesh, numbers, reference_error, monitor);
        if (monitor.interrupted)
            return;
        const auto problem = mesh.problem(numbers.keep_all, numbers.threads);
        results = run_methods({mesh.mesh(), *problem->tracer, settings, reference, nullptr, monitor,
                               problem, mesh.warnings(), 1},
                              fault, [](const StepRow&, double) {});
    });
    if (fault)
        throw SolveError(*fault);
    std::vector<StepRow> rows;
    for (const MethodRuns& method : results)
        for (const MethodRun& run : method.runs)
            rows.insert(rows.end(), run.rows.begin(), run.rows.end());
    std::erase_if(results, [](const MethodRuns& method) { return method.radiosity.empty(); });
    return py::make_tuple(rows_of(rows), summary_of(results, numbers.literal),
                          array_of(std::move(reference.radiosity)));
}

} // namespace

void add_compare(py::module_& module) { module.def("compare", &compare); }

} // namespace hemilux
