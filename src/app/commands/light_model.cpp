// hemilux MODEL: what most people want. The model is lit where it has no light that one would see,
// solved, and a picture of it is written. Then the user reads what to do next.

#include "app/commands/commands.h"
#include "app/loading/default_light.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/shell_word.h"
#include "app/terminal/log.h"
#include "io/pictures/picture_provenance.h"

#include <filesystem>
#include <string>

namespace hemilux {

namespace {

namespace fs = std::filesystem;

bool writes_something(const SolveSettings& settings) {
    return !settings.outputs.empty() || !settings.statistics.empty() ||
           !settings.steps_log.empty() || !settings.error_map.empty() || !settings.report.empty() ||
           !settings.points.output.empty();
}

/// Returns whether a picture may be made at the path: nothing is there, or what an earlier
/// `hemilux MODEL` made of this model. What anybody else made stays.
bool is_free(const std::string& path, const std::string& model) {
    std::error_code ignored;
    if (fs::symlink_status(path, ignored).type() == fs::file_type::not_found)
        return true;
    if (!fs::is_regular_file(fs::symlink_status(path, ignored)))
        return false;
    const std::string command = command_of_png(path),
                      begin = as_written("hemilux " + shell_word(model));
    return command == begin || command.starts_with(begin + " ");
}

/// Returns where the picture of a model goes, in the present folder: MODEL.png, or where that is
/// taken MODEL.lit.png, MODEL.lit-2.png and so on.
std::string picture_of(const std::string& model) {
    const std::string stem = fs::path(model).stem().string();
    std::string path = stem + ".png";
    for (int k = 1; !is_free(path, model); ++k)
        path = stem + ".lit" + (k > 1 ? "-" + std::to_string(k) : "") + ".png";
    return path;
}

/// Names the picture of a run that asks for nothing else.
void add_picture(SolveSettings& settings) {
    const std::string& model = settings.scene.path;
    const std::string path = picture_of(model), first = fs::path(model).stem().string() + ".png";
    if (path != first)
        log_line(settings.verbosity, Verbosity::normal,
                 "note: " + first + " is there already and stays; the picture is " + path);
    settings.outputs.push_back({path, OutputKind::png});
}

/// Returns commands for what people do next; `light` is the light that was put in.
std::string next_steps(const std::string& model, const std::string& light) {
    const std::string extension = extension_of(model), stem = fs::path(model).stem().string();
    const std::string scene = shell_word(model);
    const bool bakes = extension == ".glb" || extension == ".gltf" || extension == ".obj";
    const std::string baked = stem + (extension == ".obj" ? "-lit.obj" : "-lit.glb");
    return "hemilux " + std::string(bakes ? "bake " : "solve ") + scene + " " +
           (light.empty() ? "" : light + " ") + "-o " + shell_word(baked) +
           " puts the light into a file; `hemilux " + scene + "` with --report " +
           shell_word(stem + "-lit.html") + " makes a page to turn it around, with -o " +
           shell_word(stem + "-lit.csv") + " a table of its light";
}

} // namespace

int light_model(SolveSettings settings) {
    const Verbosity verbosity = settings.ranks->is_first() ? settings.verbosity : Verbosity::quiet;
    const std::string solve_command = "hemilux solve ";
    if (settings.from.command.starts_with(solve_command))
        settings.from.command.replace(0, solve_command.size(), "hemilux ");
    if (!writes_something(settings))
        add_picture(settings);
    settings.preview = true;
    std::string light;
    settings.scene.more_light = [&light, &settings, verbosity](const ReadResult& read,
                                                               SceneSettings& scene) {
        const std::optional<PutIn> put_in = put_in_light(read, scene, settings.view);
        if (!put_in)
            return;
        light = put_in->options;
        log_path(verbosity, Verbosity::normal,
                 "note: " + put_in->why + ", so this is put in:", light);
    };
    const int code = solve(settings);
    if (code == exit_done)
        log_path(verbosity, Verbosity::normal, "next:", next_steps(settings.scene.path, light));
    return code;
}

} // namespace hemilux
