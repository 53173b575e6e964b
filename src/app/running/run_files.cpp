#include "app/running/run_files.h"

#include "app/gathering/lit_file_output.h"
#include "app/running/same_run.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/shell_word.h"
#include "io/files/atomic_file.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "radiosity/answers/lightmaps/lightmap.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hemilux {

namespace {

using RoleAndPath = std::pair<std::string, std::string>;

/// Returns the files of --lightmap.
std::vector<std::string> paths_of_lightmaps(const SolveSettings& settings) {
    std::vector<std::string> paths;
    for (const Output& output : settings.outputs)
        if (settings.writes_lightmap() && is_own_file(output.kind)) {
            if (output.path == standard_output)
                throw UsageError("a lightmap takes its name from the .glb file; -o -.glb has none");
            if (!settings.file_bake.per_object) // else check_object_files() knows them
                paths.push_back(lightmap_path(output.path));
        }
    if (settings.writes_lightmap() && paths.empty() && !settings.file_bake.per_object)
        throw UsageError("--lightmap is for .glb files; add -o scene.glb");
    return paths;
}

/// Returns what the run leaves behind, but for checkpoints.
std::vector<RoleAndPath> results_of(const SolveSettings& settings) {
    std::vector<RoleAndPath> results;
    for (const Output& output : settings.outputs)
        results.emplace_back("output", output.path);
    for (const std::string& path : paths_of_lightmaps(settings))
        results.emplace_back("file of --lightmap", path);
    for (const auto& [role, path] : {std::pair("file of --points-output", settings.points.output),
                                     std::pair("file of --error-map", settings.error_map),
                                     std::pair("file of --stats", settings.statistics),
                                     std::pair("file of --report", settings.report),
                                     std::pair("file of --steps-log", settings.steps_log)})
        if (!path.empty())
            results.emplace_back(role, path);
    return results;
}

void check_points(const SolveSettings& settings) {
    if (settings.points.path.empty() != settings.points.output.empty())
        throw UsageError(settings.points.path.empty()
                             ? "--points-output is the table of --points; add --points FILE"
                             : "--points needs a file for its table; add --points-output "
                               "light.csv (or /dev/stdout)");
}

void check_every_step(const SolveSettings& settings) {
    if (!settings.every_step)
        return;
    if (std::ranges::none_of(settings.outputs, is_picture, &Output::kind))
        throw UsageError("--every-step is for pictures; add -o picture.png");
    if (std::ranges::find(settings.outputs, standard_output, &Output::path) !=
        settings.outputs.end())
        throw UsageError("--every-step names a file for each step; -o - has no name");
}

void list_inputs(const SolveSettings& settings, RunFiles& files) {
    files.read("scene", settings.scene.path);
    if (!settings.scene.config.empty())
        files.read("file of --config", settings.scene.config);
    if (!settings.reference.empty())
        files.read("reference", settings.reference);
    if (!settings.points.path.empty())
        files.read("file of --points", settings.points.path);
    for (const std::string& path : settings.target.points)
        files.read("file of --for", path);
    read_resumed_file(settings.checkpoint, files);
}

void check_readable(const SolveSettings& settings) {
    for (const std::string& path : {settings.reference, settings.points.path})
        if (!path.empty())
            check_input(path, InputKind::stream);
    for (const std::string& path : settings.target.points)
        check_input(path, InputKind::regular);
    if (is_same_stream(settings.reference, settings.points.path))
        throw UsageError("--reference and --points: '" + settings.points.path +
                         "' is a pipe, which can be read once");
}

/// `bake` reads its scene twice, and writes it as what it is.
void check_bake(const SolveSettings& settings) {
    if (!settings.file_bake.asked)
        return;
    const std::string extension = extension_of(settings.scene.path);
    const bool is_obj_scene = is_obj(settings.scene.path);
    if (extension != ".gltf" && extension != ".glb" && !is_obj_scene)
        throw UsageError(
            "bake is for glTF and OBJ files (.gltf, .glb, .obj); for '" + settings.scene.path +
            "' hemilux solve -o lit.glb --lightmap 1024 writes a mesh with a lightmap");
    if (is_obj_scene != is_obj(settings.outputs.front().path))
        throw UsageError(is_obj_scene
                             ? "bake writes an OBJ file as it is; name it -o lit.obj (hemilux "
                               "solve -o lit.glb --lightmap 1024 writes a mesh of its own)"
                             : "bake writes a glTF file as it is; name it -o lit.glb");
    if (is_obj_scene && settings.file_bake.per_object)
        throw UsageError("--per-object is for glTF files");
    if (is_obj_scene && settings.file_bake.binding != Binding::texture)
        throw UsageError("materials of OBJ files have no place for their light; --bind texture "
                         "writes texture coordinates alone");
    if (std::filesystem::exists(settings.scene.path))
        check_input(settings.scene.path, InputKind::regular);
}

/// Checks the files of --per-object. Those that the scene names are among its inputs.
void check_object_files(const SolveSettings& settings, std::span<const std::string> lightmaps,
                        std::span<const std::string> further_inputs) {
    RunFiles files;
    for (const auto& [role, path] : results_of(settings))
        files.write(role, path);
    for (const std::string& path : lightmaps)
        files.write("lightmap of --per-object", path);
    list_inputs(settings, files);
    for (const std::string& path : further_inputs)
        if (!path.empty())
            files.read("file of the scene", path);
    for (const std::string& path : lightmaps)
        check_writable(path);
}

} // namespace

void check_lightmap(const SolveSettings& settings, const Mesh& mesh) {
    if (!settings.lightmap || settings.file_bake.asked) // whose layouts are found for themselves
        return;
    try {
        (void)find_charts(mesh, *settings.lightmap);
    } catch (const LightmapTooSmall& error) {
        throw OutputError(paths_of_lightmaps(settings).front(),
                          std::string(error.what()) + "; --lightmap asks for more");
    }
}

RunFiles check_files(const SolveSettings& settings) {
    check_bake(settings);
    std::vector<RoleAndPath> written = results_of(settings);
    check_points(settings);
    if (written.empty())
        throw UsageError("nothing would be written; add an output such as -o picture.png, or let " +
                         ("`hemilux " + shell_word(settings.scene.path) + "` name a picture"));
    check_every_step(settings);
    if (!settings.checkpoint.path.empty())
        written.emplace_back("checkpoint", settings.checkpoint.path);
    RunFiles files;
    for (const auto& [role, path] : written)
        files.write(role, path);
    for (const Output& output : settings.outputs)
        if (settings.every_step && is_picture(output.kind))
            files.write_steps(output.path);
    list_inputs(settings, files);
    for (const auto& [role, path] : written)
        check_writable(path);
    check_readable(settings);
    return files;
}

FileLightmap lightmaps_to_write(const SolveSettings& settings, const Mesh& mesh,
                                const std::vector<PrimitiveOrigin>& origins,
                                std::vector<std::string>& warnings) {
    FileLightmap file = lightmap_of_file(settings, mesh, origins, warnings);
    if (!settings.file_bake.per_object)
        return file;
    std::vector<std::string> inputs = file.source->buffers().files();
    inputs.insert(inputs.end(), file.source->pictures().begin(), file.source->pictures().end());
    check_object_files(settings, lightmap_paths(settings.outputs.front().path, file), inputs);
    return file;
}

} // namespace hemilux
