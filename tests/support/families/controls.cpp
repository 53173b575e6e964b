// Ordinary scenes, on which a method that is careful with the others must not do worse than before.
// Their references are means of several runs of the method `matrix`, whose spread is their error.

#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "support/example_scenes.h"
#include "support/families/builders.h"
#include "support/families/families.h"
#include "support/scenes.h"

#include <numeric>

namespace hemilux::test {
namespace {

/// Runs with different seeds, each up to an estimated error; the standard error of their mean.
HardScene with_long_runs(Scene scene, double error) {
    constexpr int runs = 3;
    HardScene hard;
    hard.scene = std::move(scene);
    const Mesh mesh = layered_mesh(hard.scene);
    const MadeTracer made = make_tracer(mesh);
    const std::size_t n = mesh.patches().size();
    hard.reference.resize(n);
    hard.reference_error.resize(n);
    for (int k = 0; k < runs; ++k) {
        SolveOptions options;
        options.seed = 1'000'003 + static_cast<std::uint64_t>(k);
        options.stop.error = error;
        Monitor monitor;
        const SolverInput input{mesh, *made.tracer, options, monitor};
        const auto solver = find_method("matrix")->make(input);
        run(*solver, input, {.steps = {}, .seconds = {}, .error = error});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3& sigma = solver->solution().standard_error[i];
            hard.reference[i] += solver->solution().radiosity[i] / double(runs);
            hard.reference_error[i] += sigma * sigma / double(runs * runs);
        }
    }
    for (Vec3& e : hard.reference_error)
        e = glm::sqrt(e);
    hard.parts.emplace_back(n);
    std::iota(hard.parts[0].begin(), hard.parts[0].end(), 0u);
    return hard;
}

/// With .002 the reference is finer than the default stop of `matrix` too.
HardSceneEntry example(const char* name, double error = .002) {
    return {"control", name, [name, error] { return with_long_runs(example_scene(name), error); }};
}

} // namespace

Entries controls() {
    return {{"control", "room with block", [] { return with_long_runs(room_with_block(), .004); }},
            {"control", "open scene", [] { return with_long_runs(open_scene(), .004); }},
            example("cornell_box"),
            example("room_1002"),
            example("open_scene"),
            example("wall_before_crowd"),
            example("office_3576", .004)};
}

} // namespace hemilux::test
