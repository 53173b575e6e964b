// hemilux info: what was read, what is doubtful in it, and what it does not need.

#include "app/commands/commands.h"
#include "app/loading/lights.h"
#include "app/loading/load.h"
#include "app/loading/sides.h"
#include "app/memory/memory.h"
#include "app/settings/exit_code.h"
#include "app/terminal/log.h"
#include "app/terminal/print.h"
#include "app/terminal/stage.h"
#include "app/terminal/wrap.h"
#include "io/results/scene_info_json.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/answers/division/needed_division.h"
#include "radiosity/engine/needs/find_needs.h"

#include <cmath>
#include <unistd.h>

namespace hemilux {

namespace {

std::string describe(const SceneReport& report, const Scene& scene, const SceneSettings& asked) {
    std::string text = describe(report.info);
    if (scene.facets.empty())
        return text;
    const std::vector<std::string> lamps = likely_lamps(scene);
    if (report.info.emitters.empty() && !lamps.empty())
        text += info_line("lamps by name", list_names(lamps) + " (--emission makes them shine)");
    text += report.sides ? describe(*report.sides, scene, asked.sides) : describe_both_sides(scene);
    if (asked.mesh.max_edge > 0 || asked.mesh.two_sided)
        text += info_line("patches", std::to_string(report.patches) + " (as divided)");
    if (report.error_division && std::isnan(*report.error_division))
        text +=
            info_line("within patches",
                      "it is not known how much the light differs: half a minute was not enough");
    else if (report.error_division)
        text +=
            info_line("within patches", "light differs by " + percent(*report.error_division) +
                                            " (--divide auto divides them where it is too much)");
    const bool is_dark = report.info.emitters.empty() && report.info.points.empty();
    return is_dark ? text : text + describe(report.left_out); // of a dark scene, all is left out
}

/// The scene is there once as it was read, and once with its faces turned.
MemoryNeed need_of(const Scene& scene, const SceneSettings& asked) {
    MemoryNeed need = memory_need(scene, asked.mesh, {}, {});
    need.scene +=
        sizeof(Vec3) * double(scene.vertices.size()) + sizeof(Facet) * double(scene.facets.size());
    return need;
}

} // namespace

int info(const InfoSettings& settings) {
    const SceneSettings& asked = settings.scene;
    std::optional<Stage> stage(std::in_place, "looking at the scene", settings.verbosity);
    check_memory_to_read(asked.path, asked.memory);
    const ReadResult read = load_scene(asked, {});
    check_memory(need_of(read.scene, asked), asked.memory, asked.path,
                 "a larger --max-edge needs less");
    for (const std::string& warning : read.warnings)
        log_line(settings.verbosity, Verbosity::normal, "warning: " + warning);
    SceneReport report{
        .info = inspect(read), .sides = {}, .left_out = {}, .warnings = read.warnings};
    if (!read.scene.facets.empty()) {
        Scene scene = read.scene;
        if (asked.sides != Sides::both)
            report.sides = find_orientation(scene);
        if (asked.sides == Sides::automatic)
            turn_faces(scene, *report.sides);
        const Mesh mesh = divide_scene(std::move(scene), asked);
        report.patches = mesh.patches().size();
        const MadeTracer made = make_tracer(mesh);
        if (const std::string slow = crowd_text(made.crowd, mesh); !slow.empty()) {
            log_line(settings.verbosity, Verbosity::normal, "warning: " + slow);
            report.warnings.push_back(slow);
        }
        report.left_out = left_out(find_needs(mesh));
        if (report.info.bad_reflectances.empty())
            report.error_division = error_within_patches(mesh, *made.tracer);
    }
    stage.reset();
    print(settings.json
              ? to_json(report)
              : message_for(STDOUT_FILENO, describe(report, read.scene, asked), info_value_column));
    return exit_done;
}

} // namespace hemilux
