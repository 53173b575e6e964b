#include "app/loading/sides.h"

#include "app/loading/load.h"
#include "app/terminal/program_watcher.h"
#include "io/scene_files/inspect.h"
#include "radiosity/answers/asked/text.h"

namespace hemilux {

SidedMesh divide_with_sides(Scene scene, const SceneSettings& settings, const SolveOptions& options,
                            Verbosity verbosity) {
    ProgramWatcher watcher(verbosity);
    return as_of_file(settings, [&] {
        MeshOptions mesh = settings.mesh;
        mesh.threads = options.threads;
        return divide_with_sides(std::move(scene), settings.sides, mesh, watcher);
    });
}

std::string describe(const Orientation& found, const Scene& scene, Sides sides) {
    std::string text;
    const auto add = [&](const std::string& name, std::size_t count, const std::string& one,
                         const std::string& many) {
        if (count > 0)
            text += info_line(name, std::to_string(count) + " (" + (count == 1 ? one : many) + ")");
    };
    if (found.faces > 0)
        text +=
            info_line("looking away",
                      std::to_string(found.faces) + " of " + counted(scene.faces, "face", "faces") +
                          " (" + names_of_groups(found.groups, scene) + "); " +
                          (sides == Sides::automatic ? "solve turns them, --sides front does not"
                                                     : "--sides auto turns them"));
    if (found.in_doubt > 0)
        text += info_line("in doubt", doubt_text(found, scene) +
                                          "; much light falls on their backs, maybe on purpose");
    add("inside out", found.inside_out, "closed surface whose back is lit",
        "closed surfaces whose backs are lit");
    add("lit from behind", found.from_behind, "open surface whose back is lit",
        "open surfaces whose backs are lit");
    add("lamps turned away", found.emitters, "it faces a wall at once, or nothing",
        "they face a wall at once, or nothing");
    add("faces disagree", found.mixed, "surface some of whose faces look away",
        "surfaces some of whose faces look away");
    add("clashing edges", found.clashing_edges,
        "edge that two faces run along in the same direction, so one of them looks away",
        "edges that two faces run along in the same direction, so one of them looks away");
    add("without sides", found.one_sided, "surface such as a Moebius strip; left as it is",
        "surfaces such as a Moebius strip; left as they are");
    if (found.light.backs + found.light.escaped > 0)
        text += info_line("light lost", percent(found.light.backs) +
                                            " of what is emitted falls on "
                                            "backs, " +
                                            percent(found.light.escaped) +
                                            " escapes (with the faces as in the file)");
    return text;
}

std::string describe_both_sides(const Scene& scene) {
    const std::string text = both_sides_text(scene);
    return text.empty() ? "" : info_line("both sides", text);
}

} // namespace hemilux
