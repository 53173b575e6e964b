#include "app/loading/load.h"

#include "app/loading/lights.h"
#include "app/loading/sides.h"
#include "app/memory/memory.h"
#include "app/rendering/view.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/terminal/log.h"
#include "app/terminal/program_watcher.h"
#include "app/terminal/stage.h"
#include "app/terminal/summary.h"
#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/scene_files/glass.h"
#include "io/scene_files/inspect.h"
#include "io/scene_files/obj.h"
#include "io/scene_files/stl.h"
#include "io/scene_files/vs3.h"
#include "parallel/stopwatch.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/light/layers/layered_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace hemilux {

namespace {

void check_reflectances(const ReadResult& read, const std::string& path) {
    std::vector<std::string> bad = find_bad_reflectances(read);
    if (bad.empty())
        return;
    if (bad.front().starts_with(path + ": ")) // of a glTF file
        bad.front().erase(0, path.size() + 2);
    const std::string more =
        bad.size() > 1 ? " (and " + std::to_string(bad.size() - 1) + " more)" : "";
    throw InputError(path, bad.front() + more +
                               "; --reflectance 'MATERIAL=R,G,B' replaces what the file says");
}

void check_emission(const Material& material, const std::string& path) {
    const Vec3& e = material.emission;
    const auto bad = [](double channel) { return !emission_range.contains(channel); };
    if (bad(e.r) || bad(e.g) || bad(e.b))
        throw InputError(path, "material '" + material.name + "' has emission " +
                                   formatted("%g,%g,%g", e.r, e.g, e.b) +
                                   "; --emission 'MATERIAL=R,G,B' replaces what the file says");
}

std::string no_light_text(const Scene& scene, const std::vector<std::string>& materials) {
    const std::vector<std::string> lamps = likely_lamps(scene);
    return "nothing emits light; `hemilux MODEL` lights a model by itself, --sky 1 lights it from "
           "all sides, --light puts in a lamp, and --emission 'MATERIAL=R,G,B' makes a material "
           "emit. Its materials: " +
           list_names(materials) +
           (lamps.empty() ? "" : "; by their names these may be lamps: " + list_names(lamps));
}

ReadResult read_by_extension(const SceneSettings& settings, const ReadGuard& guard) {
    const std::string& path = settings.path;
    const std::string extension = extension_of(path);
    if (extension == ".obj")
        return read_obj(path, guard, settings.textures, settings.outside);
    if (extension == ".gltf" || extension == ".glb")
        return read_gltf(path, guard, settings.textures, settings.outside);
    if (extension == ".stl")
        return read_stl(path, guard);
    if (extension == ".vs3")
        return read_vs3(path, guard);
    throw InputError(
        path, "expected a scene of a kind that can be read: .obj, .gltf, .glb, .stl or .vs3");
}

/// Returns whether a camera is held level only with z upwards, as where Blender exported without
/// its option +Y Up.
bool is_level_by_z(const Camera& camera) {
    const Vec3 right = glm::normalize(glm::cross(camera.target - camera.eye, camera.up));
    constexpr double level = 1e-3, tilted = .1;
    return std::abs(right.z) < level && std::abs(right.y) > tilted;
}

void warn(LoadedMesh& loaded, const std::string& text, Verbosity verbosity) {
    loaded.warnings.push_back(text);
    log_line(verbosity, Verbosity::normal, "warning: " + text);
}

} // namespace

ReadResult load_scene(const SceneSettings& settings, const RunFiles& files) {
    ReadResult read = read_by_extension(settings, memory_guard(settings.path, settings.memory));
    for (const std::string& library : read.libraries)
        files.read("file of the scene", library);
    for (const std::string& texture : read.textures)
        if (std::error_code ignored; std::filesystem::exists(texture, ignored))
            files.read("texture", texture);
    for (const LightSettings& light : settings.lights)
        if (!light.photometry.empty())
            files.read("photometry", light.photometry);
    apply_overrides(read.scene, &Material::emission, settings.emission);
    apply_overrides(read.scene, &Material::reflectance, settings.reflectance);
    if (settings.glass == Glass::open)
        open_glass(read);
    SceneSettings lights = settings;
    if (settings.more_light)
        settings.more_light(read, lights);
    add_lights(read.scene, lights);
    return read;
}

void check_solvable(const ReadResult& read, const std::string& path) {
    if (read.scene.facets.empty())
        throw InputError(path, read.scene.panes
                                   ? "all faces are panes, which --glass open makes of glass"
                                   : "there is no face with an area");
    check_reflectances(read, path);
    const std::vector<bool> used = materials_in_use(read.scene);
    std::vector<std::string> names;
    for (std::size_t m = 0; m < used.size(); ++m) {
        if (!used[m])
            continue;
        check_emission(read.scene.materials[m], path);
        names.push_back(read.scene.materials[m].name);
    }
    if (!emits(read.scene))
        throw InputError(path, no_light_text(read.scene, names));
}

InputError as_input_error(const SolveError& error, const std::string& path,
                          std::span<const std::uint32_t> face_lines) {
    return error.face < face_lines.size() ? InputError(path, face_lines[error.face], error.what())
                                          : InputError(path, error.what());
}

Mesh divide_scene(Scene scene, const SceneSettings& settings, unsigned threads) {
    MeshOptions options = settings.mesh;
    options.threads = threads;
    return as_of_file(settings, [&] { return layered_mesh(std::move(scene), options); });
}

void throw_as_of_file(const SceneSettings& settings, const std::invalid_argument& error) {
    if (settings.mesh.max_edge > 0)
        throw UsageError(std::string("--max-edge: ") + error.what());
    throw InputError(settings.path, error.what());
}

FileView view_of_file(const std::string& path, const ReadResult& read) {
    FileView view{read.camera, read.camera_name, {}};
    const std::string extension = extension_of(path);
    if (extension == ".gltf" || extension == ".glb")
        view.usual_up = read.camera && is_level_by_z(*read.camera) ? 2 : 1;
    else if (extension == ".stl")
        view.usual_up = 2;
    return view;
}

ViewSettings view_of(const ViewSettings& asked, const FileView& file, Verbosity verbosity) {
    ViewSettings view = asked;
    view.usual_up = file.usual_up;
    if (view.camera && view.up && !view.camera_has_up) {
        view.camera->up = Vec3(0.0);
        view.camera->up[*view.up] = 1;
    }
    if (view.camera || !view.uses_camera_of_scene || !file.camera)
        return view;
    view.camera = as_printed(*file.camera);
    log_line(verbosity, Verbosity::normal,
             "pictures are seen by camera '" + file.camera_name + "' of the scene: " +
                 camera_text(*view.camera) + "; --camera auto chooses another");
    return view;
}

Prepared prepare(LoadedMesh& loaded, const SolveOptions& options, Verbosity verbosity) {
    const Stopwatch preparing;
    /// Keeps what it warns of.
    struct Keeping : ProgramWatcher {
        Keeping(Verbosity wanted, std::vector<std::string>& warnings)
            : ProgramWatcher(wanted), kept(warnings) {}
        void take(const Finding& finding) override {
            if (finding.kind == Finding::Kind::warning)
                kept.push_back(finding.with_advice());
            ProgramWatcher::take(finding);
        }
        std::vector<std::string>& kept;
    };
    Keeping watcher(verbosity, loaded.warnings);
    std::optional<Stage> stage(std::in_place, "building the tree", verbosity);
    Problem problem =
        prepare(std::make_shared<Mesh>(std::move(loaded.mesh)), std::move(loaded.made),
                {.keep_all = options.keep_all, .threads = options.threads}, watcher);
    stage.reset();
    const double seconds = loaded.seconds_sides + preparing.seconds();
    return {std::move(problem), seconds};
}

LoadedMesh load_mesh(const SceneSettings& settings, const RunFiles& files,
                     const SolveOptions& options, std::span<const Method* const> methods,
                     Verbosity verbosity,
                     const std::function<double(double patches)>& bytes_of_results,
                     const Method* before) {
    const Stopwatch reading;
    const Stage stage("reading", verbosity);
    check_memory_to_read(settings.path, settings.memory);
    ReadResult read = load_scene(settings, files);
    log_warnings(verbosity, read.warnings);
    check_solvable(read, settings.path);
    const double seconds = reading.seconds();
    MemoryNeed need = memory_need(read.scene, settings.mesh, options, methods, before);
    need.results = bytes_of_results(patches_of(read.scene, settings.mesh));
    check_memory(need, settings.memory, settings.path);
    const Stopwatch dividing;
    SidedMesh sided = divide_with_sides(std::move(read.scene), settings, options, verbosity);
    LoadedMesh loaded{std::move(sided.mesh),
                      std::move(sided.made),
                      seconds,
                      dividing.seconds(),
                      std::move(read.face_lines),
                      view_of_file(settings.path, read),
                      std::move(read.warnings),
                      need,
                      std::move(read.origins)};
    if (!loaded.mesh.all_layers_are_offset())
        warn(loaded,
             settings.path +
                 ": very many faces lie over each other in one plane; for some of them it was not "
                 "found out which of two covers the other, and rays meet either",
             verbosity);
    log_line(verbosity, Verbosity::verbose, mesh_text(loaded.mesh));
    return loaded;
}

} // namespace hemilux
