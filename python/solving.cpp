// solve: a run of a method, and what it found as arrays.

#include "python/parts.h"
#include "python/run.h"
#include "python/waiting.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/paper/solution/error_spread.h"

#include <pybind11/stl.h>

namespace hemilux {
namespace {

py::array_t<double> colour(const Vec3& value) {
    return array_of(std::vector<double>{value.r, value.g, value.b});
}

py::dict energy_of(const EnergyBalance& energy) {
    py::dict result;
    result["emitted"] = colour(energy.emitted);
    result["absorbed"] = colour(energy.absorbed);
    result["escaped"] = colour(energy.escaped);
    result["unshot"] = colour(energy.unshot);
    return result;
}

py::dict steps_of(RunResult& run) {
    const std::vector<StepRecord>& steps = run.run.steps;
    const std::size_t n = steps.size();
    py::dict result;
    result["step"] = array_by<std::int64_t>(n, [&](std::size_t k) { return steps[k].step; });
    result["rays"] = array_by<std::uint64_t>(n, [&](std::size_t k) { return steps[k].rays; });
    result["seconds"] = array_by<double>(n, [&](std::size_t k) { return steps[k].seconds; });
    result["estimated_error"] =
        array_by<double>(n, [&](std::size_t k) { return steps[k].estimated_error; });
    if (!run.true_errors.empty())
        result["true_error"] = array_of(std::move(run.true_errors));
    return result;
}

py::dict result_of(const PythonMesh& mesh, const SolveSettings& settings, RunResult& run) {
    const Solution& found = run.run.solution();
    py::dict result;
    const double error = estimated_error(mesh.mesh(), found);
    result["method"] = std::string(settings.method->name);
    result["seed"] = run.run.options->seed;
    result["steps"] = steps_of(run);
    result["estimated_error"] = error;
    result["uncertainty"] = error * error_spread(mesh.mesh(), found).uncertainty();
    result["energy"] = energy_of(found.energy);
    result["rays_energy"] = found.rays_energy;
    result["rays_density"] = found.rays_density;
    result["bytes_density"] = found.bytes_density;
    result["seconds"] = run.run.seconds;
    py::list not_done;
    if (!run.run.options->keep_all)
        for (const LeftOut& left : left_out(run.run.problem->needs, settings.work(), found))
            not_done.append(py::make_tuple(left.what, left.why, left.saved));
    result["left_out"] = not_done;
    py::list warnings;
    for (const Finding& finding : run.findings)
        if (finding.kind == Finding::Kind::warning)
            warnings.append(finding.text); // the advice names options of the command line
    result["warnings"] = warnings;
    // The solver's own arrays would not outlive it.
    result["radiosity"] = array_of(std::vector<Vec3>(found.radiosity));
    result["standard_error"] = array_of(std::vector<Vec3>(found.standard_error));
    return result;
}

py::dict solve_mesh(const PythonMesh& mesh, const std::string& method, const RunNumbers& numbers,
                    const std::optional<Doubles>& reference, const py::object& progress) {
    const SolveSettings settings = settings_of(method_named(method), numbers);
    const std::span<const Vec3> known = reference ? rows_of(*reference) : std::span<const Vec3>{};
    Monitor monitor;
    std::optional<RunResult> run;
    run_without_lock(monitor, progress,
                     [&] { run.emplace(run_method(mesh, settings, known, monitor)); });
    return result_of(mesh, settings, *run);
}

py::list described_methods() {
    py::list result;
    for (const Method* const method : methods())
        result.append(py::make_tuple(std::string(method->name), std::string(method->summary)));
    return result;
}

} // namespace

void add_solve(py::module_& module) {
    py::class_<RunNumbers>(module, "RunNumbers")
        .def(py::init<>())
        .def_readwrite("error", &RunNumbers::error)
        .def_readwrite("seconds", &RunNumbers::seconds)
        .def_readwrite("rays", &RunNumbers::rays)
        .def_readwrite("steps", &RunNumbers::steps)
        .def_readwrite("max_rays", &RunNumbers::max_rays)
        .def_readwrite("depth", &RunNumbers::depth)
        .def_readwrite("threshold", &RunNumbers::threshold)
        .def_readwrite("literal", &RunNumbers::literal)
        .def_readwrite("keep_all", &RunNumbers::keep_all)
        .def_readwrite("seed", &RunNumbers::seed)
        .def_readwrite("threads", &RunNumbers::threads)
        .def_readwrite("own", &RunNumbers::own);
    module.def("solve", &solve_mesh);
    module.def("methods", &described_methods);
}

} // namespace hemilux
