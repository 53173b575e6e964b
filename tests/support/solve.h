#pragma once
// A mesh with the tracer of the program, and a run of a method over it.

#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace hemilux::test {

struct Model {
    Mesh mesh;
    WideBvh bvh;
    explicit Model(Mesh made) : mesh(std::move(made)), bvh(mesh.soup()) {}
    explicit Model(Scene scene, const MeshOptions& options = {})
        : Model(Mesh(std::move(scene), options)) {}
};

/// The solution after some steps, or at an error.
[[nodiscard]] inline Solution solve(const Model& model, const Method& method,
                                    const SolveOptions& options, const StopRule& stop) {
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = method.make(input);
    run(*solver, input, stop);
    return solver->solution();
}

/// The same with what the scene does not need left out, as the program does.
[[nodiscard]] inline Solution solve_as_needed(const Model& model, const Method& method,
                                              const SolveOptions& options, const StopRule& stop) {
    Monitor monitor;
    const Needs needs = find_needs(model.mesh);
    const SolverInput input{model.mesh, model.bvh, options, monitor, needs};
    const auto solver = method.make(input);
    run(*solver, input, stop);
    return solver->solution();
}

[[nodiscard]] inline StopRule steps(std::uint32_t n) {
    return {.steps = n, .seconds = {}, .error = {}};
}

/// By `matrix`, to a relative error.
[[nodiscard]] inline Solution reference(const Model& model, double error) {
    SolveOptions options;
    options.seed = 12345;
    return solve(model, *find_method("matrix"), options,
                 {.steps = {}, .seconds = {}, .error = error});
}

/// Loads what `from` saves into `to`, which must take all of it; returns the state.
inline std::string hand_over(const EngineSolver& from, EngineSolver& to) {
    StateWriter state;
    from.save(state);
    StateReader reader(state.bytes());
    to.load(reader);
    reader.expect_end();
    return state.bytes();
}

[[nodiscard]] inline bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

} // namespace hemilux::test
