// Asks for light by the three calls of src/radiosity/answers: a problem is prepared, a run solves
// it, and light is gathered from it, each answer with its error.
//
//     14_answers MODEL.glb PICTURE.png
//
// prints the irradiance at two points on the table and writes a picture.
#include "io/gltf/gltf.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/gathering/light_of_picture.h"
#include "radiosity/answers/gathering/light_of_points.h"
#include "radiosity/answers/run/run.h"
#include "radiosity/answers/run/sides.h"
#include "radiosity/answers/views/automatic_camera.h"

#include <cstdio>
#include <utility>

using namespace hemilux;

int main(int count, char** arguments) {
    if (count != 3)
        return 1;
    Monitor monitor;
    RunWatcher watcher;
    SidedMesh sided = divide_with_sides(read_gltf(arguments[1]).scene, Sides::automatic,
                                        {.max_edge = .5}, watcher);
    const auto problem = std::make_shared<const Problem>(
        prepare(std::make_shared<Mesh>(std::move(sided.mesh)), std::move(sided.made), {}, watcher));

    const Run run =
        solve(problem, {.method = find_method("stored-transport"), .stop = {.error = .02}}, monitor,
              watcher);

    const LitScene scene{run.mesh(), *problem->tracer, run.solution().radiosity};
    Gatherer gatherer(scene, run.solution(), {.error = .02}, monitor, watcher);
    const WantedPoint on_table[] = {{{1.6, .75, 1.3}, {0, 1, 0}}, {{2, .75, 1.5}, {0, 1, 0}}};
    const auto points = gather_points(gatherer, on_table);
    for (const PointLight& at : points.value.found.lights)
        std::printf("%.1f W/m2 of red light, standard error %.2f\n", at.irradiance.r,
                    at.standard_error.r);
    const WantedPicture wanted{
        .camera = automatic_camera(scene.mesh, scene.tracer, scene.radiosity), .size = {320, 240}};
    const auto picture = gather_picture(gatherer, wanted);
    std::printf("points: error %.2g, surely below %.2g; picture: %.2g, %.2g\n", points.error.whole,
                points.error.bound, picture->error.whole, picture->error.bound);
    write_png(arguments[2], picture->value.image, auto_exposure(picture->value.image));
    return points.error.bound < .05 && picture->error.bound < .05 ? 0 : 1;
}
