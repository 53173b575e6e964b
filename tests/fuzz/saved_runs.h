#pragma once
// The runs whose checkpoints are in corpus/checkpoint_sealed (make_checkpoints.sh).

#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/scene/scene.h"
#include "radiosity/paper/solving/solve_options.h"

#include <utility>
#include <vector>

namespace hemilux::fuzz {

/// That of corpus/obj/facing.obj, with everything emitting.
inline Scene facing_triangles() {
    Scene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
    scene.materials = {{"lamp", Vec3(.5), Vec3(1)}};
    scene.groups = {"default"};
    scene.facets = {{{0, 1, 2, 2}, 0, 0, 0}, {{3, 4, 5, 5}, 1, 0, 0}};
    scene.faces = 2;
    return scene;
}

/// All methods that can resume, and one with a guide that learns, which saves more.
inline std::vector<std::pair<const Method*, SolveOptions>> saved_runs() {
    const SolveOptions usual{.rays = 4, .threads = 1};
    std::vector<std::pair<const Method*, SolveOptions>> runs;
    for (const Method* const method : methods())
        if (method->can_resume())
            runs.emplace_back(method, usual);
    for (const Guide* const guide : additions().guides)
        if (guide->name == "learned") {
            runs.emplace_back(find_method("hemisphere"), usual);
            set_own_options(runs.back().second, GuideChoice{.guide = guide});
        }
    return runs;
}

} // namespace hemilux::fuzz
