// The Cornell box, from the file to the picture:
//     06_cornell_box [SCENE.obj [PICTURE.png]]
//
// Shows: all that a program needs: read, divide, build the tree, take steps of the hemisphere
// subdivision method, render through a camera.
// Prints: the estimated error after each step that doubles the rays, at last where the picture is.

#include "bvh/wide/wide_bvh.h"
#include "io/pictures/picture_files.h"
#include "io/scene_files/obj.h"
#include "radiosity/answers/pictures/render.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/engine/solving/run.h"
#include "radiosity/paper/scene/mesh.h"

#include <bit>
#include <cstdio>
#include <exception>

using namespace hemilux;

namespace {

/// Returns the estimated error.
double solve_and_draw(const char* scene, const char* picture) {
    const Mesh mesh(read_obj(scene).scene);
    const WideBvh bvh(mesh.soup());
    const SolveOptions options;
    Monitor monitor;
    const SolverInput input{mesh, bvh, options, monitor};
    const auto solver = find_method("hemisphere")->make(input);
    run(*solver, input, {.steps = 32, .seconds = {}, .error = {}},
        [](const StepRecord& record, const Solution&) {
            if (std::has_single_bit(record.step) && record.step > 1)
                std::printf("step %2u: %8llu rays, estimated error %4.1f %%\n", record.step,
                            static_cast<unsigned long long>(record.rays),
                            100 * record.estimated_error);
        });
    // In front of the open side, as in the photographs of Goral et al. 1984.
    const Camera camera{{.275, .275, 1.36}, {.275, .275, 0}, {0, 1, 0}, 40};
    const Image image = render(mesh, bvh, solver->solution().radiosity, camera, {512, 512});
    write_png(picture, image, auto_exposure(image));
    std::printf("%zu patches; wrote %s\n", mesh.patches().size(), picture);
    return estimated_error(mesh, solver->solution());
}

} // namespace

int main(int argc, char** argv) {
    try {
        constexpr double good_enough = 0.03;
        const double error = solve_and_draw(argc > 1 ? argv[1] : "examples/scenes/cornell_box.obj",
                                            argc > 2 ? argv[2] : "cornell_box.png");
        return error < good_enough ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "06_cornell_box: %s\n", error.what());
        return 1;
    }
}
