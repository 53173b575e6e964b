#pragma once
// Targets of scenes, and the true error of what is found for them.

#include "radiosity/engine/target/target.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solution.h"
#include "support/example_scenes.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemilux::test {

[[nodiscard]] inline Solution solve_for(const Model& model, const Method& method,
                                        std::span<const double> target, const SolveOptions& options,
                                        const StopRule& stop) {
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor, everything_needed, target};
    const auto solver = method.make(input);
    run(*solver, input, stop);
    return solver->solution();
}

/// Of groups whose names begin with this.
[[nodiscard]] inline std::vector<double> weights_of(const Mesh& mesh, const std::string& prefix) {
    std::vector<std::uint32_t> groups;
    for (std::uint32_t g = 0; g < mesh.scene().groups.size(); ++g)
        if (mesh.scene().groups[g].starts_with(prefix))
            groups.push_back(g);
    return weights_of_groups(mesh, groups);
}

/// Relative, of the patches that have weight.
[[nodiscard]] inline double true_error_of(const Mesh& mesh, const Solution& solution,
                                          const Solution& exact, std::span<const double> weight) {
    std::vector<bool> counts;
    for (const double each : weight)
        counts.push_back(each > 0);
    return true_error(mesh, solution.radiosity, exact.radiosity, counts).detail;
}

[[nodiscard]] inline Model example(const std::string& name) { return Model(example_scene(name)); }

/// Two rooms without a door: the first 96 patches and the others. The second one shines less.
[[nodiscard]] inline Scene two_rooms() {
    const Material white{"white", Vec3(.5), Vec3(0.0)}, lamp{"lamp", Vec3(.5), Vec3(1.0)},
        faint{"faint", Vec3(.5), Vec3(.1)};
    Scene scene = box_room({0, 0, 0}, {1, 1, 1}, 4, {white, lamp, faint}, {1, 0, 0, 0, 0, 0});
    const Scene other = box_room({2, 0, 0}, {3, 1, 1}, 4, {white, lamp, faint}, {2, 0, 0, 0, 0, 0});
    add_scene(scene, other);
    return scene;
}

[[nodiscard]] inline std::vector<double> first_room(const Mesh& mesh) {
    std::vector<double> weight(mesh.patches().size());
    std::fill_n(weight.begin(), weight.size() / 2, 1.0);
    return weight;
}

} // namespace hemilux::test
