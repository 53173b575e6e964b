// Uses the library from its installed headers: a lamp above a floor, solved in one step.
#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdio>

int main() {
    using namespace hemilux;
    Scene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0}, {{4, 5, 6, 7}, 1, 1, 0}};
    scene.materials = {{"floor", Vec3(0.5), Vec3(0.0)}, {"lamp", Vec3(0.0), Vec3(1.0)}};
    scene.groups = {"all"};
    scene.faces = 2;

    const Mesh mesh(scene);
    const WideBvh bvh(mesh.soup());
    const SolveOptions options{.rays = 10000};
    Monitor monitor;
    const SolverInput input{mesh, bvh, options, monitor};
    const auto solver = find_method("hemisphere")->make(input);
    if (!solver->step())
        return 1;
    // Opposed unit squares at distance 1: F = .19982490 (Howell C-11), so B = .5 F.
    const double radiosity = solver->solution().radiosity[0].r;
    std::printf("%g, expected 0.0999\n", radiosity);
    return radiosity > 0.095 && radiosity < 0.105 ? 0 : 1;
}
