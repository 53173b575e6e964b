#include "app/load_geometry.h"

#include "app/load.h"
#include "app/sides.h"
#include "app/summary.h"
#include "app/talk.h"
#include "io/error.h"

namespace hemilux {

Mesh load_geometry(const SceneSettings& settings, Talk talk) {
    ReadResult read = load_scene(settings);
    say_warnings(talk, read.warnings);
    if (read.scene.facets.empty())
        throw InputError(settings.path, "there is no face with an area");
    settle_sides(read.scene, settings, talk);
    Mesh mesh = divide_scene(std::move(read.scene), settings);
    say(talk, Talk::verbose, mesh_text(mesh));
    return mesh;
}

} // namespace hemilux
