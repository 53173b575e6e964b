// hemilux info: what was read, what is doubtful in it, and what it does not need.

#include "app/commands/commands.h"
#include "app/loading/load.h"
#include "app/loading/sides.h"
#include "app/settings/exit_code.h"
#include "app/terminal/log.h"
#include "io/files/error.h"
#include "io/files/printable.h"
#include "io/scene_files/inspect.h"

#include <iostream>

namespace hemilux {

namespace {

void print(const std::string& text) { std::cout << printable_message(text); }

/// The scene as it is solved; prints what its sides are like.
Scene with_sides(Scene scene, Sides sides) {
    if (sides == Sides::both) {
        print(describe_both_sides(scene));
        return scene;
    }
    const Orientation found = find_orientation(scene);
    print(describe(found, scene, sides));
    if (sides == Sides::automatic)
        turn_faces(scene, found);
    return scene;
}

} // namespace

int info(const InfoSettings& settings) {
    ReadResult read = load_scene(settings.scene, {});
    for (const std::string& warning : read.warnings)
        log_line(settings.verbosity, Verbosity::normal, "warning: " + warning);
    print(describe(inspect(read)));
    if (!read.scene.facets.empty()) {
        const Mesh mesh =
            divide_scene(with_sides(std::move(read.scene), settings.scene.sides), settings.scene);
        if (settings.scene.mesh.max_edge > 0 || settings.scene.mesh.two_sided)
            std::cout << "patches             " << mesh.patches().size() << " (as divided)\n";
        print(describe(left_out(find_needs(mesh))));
    }
    std::cout.flush();
    if (!std::cout)
        throw OutputError("standard output", "cannot be written");
    return exit_done;
}

} // namespace hemilux
