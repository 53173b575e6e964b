// Any bytes as a checkpoint, as they are and with a first line, length and checksum that are right:
// refused by InputError, or read and written again to the same bytes; its state loads or is
// refused, by both kinds of solvers.

#include "bvh/brute_force.h"
#include "io/files/error.h"
#include "io/results/checkpoint.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/paper/scene/mesh.h"

#include <cstdlib>
#include <memory>
#include <vector>

namespace {

using namespace hemilux;

Scene one_triangle() {
    Scene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.materials = {{"lamp", Vec3(.5), Vec3(1)}};
    scene.groups = {"default"};
    scene.facets = {{{0, 1, 2, 2}, 0, 0, 0}};
    return scene;
}

/// A solver of each kind. They are made once: a state replaces all of the one before.
std::vector<std::unique_ptr<EngineSolver>> make_solvers() {
    static const Mesh mesh(one_triangle());
    static const BruteForce tracer(mesh.soup());
    static const SolveOptions options{.threads = 1};
    static Monitor monitor;
    std::vector<std::unique_ptr<EngineSolver>> solvers;
    for (const char* name : {"progressive-monte-carlo", "stored-transport"})
        solvers.push_back(
            find_method(name)->make({mesh, tracer, options, monitor, everything_needed}));
    return solvers;
}

void load(std::string_view state) {
    static const std::vector<std::unique_ptr<EngineSolver>> solvers = make_solvers();
    for (const auto& solver : solvers)
        try {
            StateReader reader(state);
            solver->load(reader);
        } catch (const StateError&) {
        }
}

void read(const std::string& bytes) {
    try {
        const Checkpoint checkpoint = checkpoint_from(bytes, "saved");
        load(checkpoint.state);
        if (to_bytes(checkpoint_from(to_bytes(checkpoint), "saved")) != to_bytes(checkpoint))
            std::abort();
    } catch (const InputError&) {
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    read(bytes);
    read(sealed_checkpoint(bytes));
    load(bytes);
    return 0;
}
