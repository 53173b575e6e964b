#include "app/command_line/option_groups.h"

#include "app/command_line/option_kinds.h"
#include "app/settings/exit_code.h"
#include "app/settings/memory.h"
#include "app/settings/names.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

namespace hemilux {

namespace {

CLI::Option* add_override(CLI::App& app, const std::string& name, std::vector<Override>& list,
                          const NumberRange& range, const std::string& help) {
    const auto parse = [range](const std::string& text) { return parse_override(text, range); };
    return repeatable(add_parsed(app, name, "MATERIAL=R,G,B", help,
                                 "MATERIAL=R,G,B or MATERIAL=GREY with numbers " + range.text(),
                                 parse, [&list](const Override& value) { list.push_back(value); }));
}

std::optional<Camera> camera_from(const std::string& text) {
    try {
        const Camera camera = parse_camera(text);
        return camera.eye != camera.target ? std::optional(camera) : std::nullopt;
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

void choose_sides(SceneSettings& scene, Sides sides) {
    scene.sides = sides;
    scene.mesh.two_sided = sides == Sides::both;
}

void add_sides_options(CLI::App& app, SceneSettings& scene) {
    CLI::Option* const sides = app.add_option_function<std::string>(
        "--sides",
        [&scene](const std::string& name) {
            const auto found = std::ranges::find(sides_names, name);
            if (found == sides_names.end()) {
                const std::vector<std::string> names(sides_names.begin(), sides_names.end());
                throw UsageError("--sides: " + unknown_name("choice", name, names));
            }
            choose_sides(scene, static_cast<Sides>(found - sides_names.begin()));
        },
        "which sides of faces emit and reflect. auto: the front, faces that look away from the "
        "light being turned; front: the front as in the file; both [auto]");
    sides->type_name("auto|front|both")->group("Scene");
    app.add_flag_callback(
           "--two-sided", [&scene] { choose_sides(scene, Sides::both); },
           "the same as --sides both")
        ->group("Scene")
        ->excludes(sides);
}

} // namespace

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& type,
                      std::string& target, const std::string& help) {
    return app.add_option(name, target, help)->type_name(type);
}

void add_scene_options(CLI::App& app, SceneSettings& scene) {
    add_text(app, "SCENE", "FILE", scene.path, "the scene: Wavefront .obj")->required();
    add_number(app, "--max-edge", "LENGTH", scene.mesh.max_edge, positive,
               "divide faces until no edge is longer [not divided]")
        ->group("Scene");
    add_sides_options(app, scene);
    add_override(app, "--emission", scene.emission, emission_range,
                 "what a material emits, W/m2; * for all; repeatable")
        ->group("Scene");
    add_override(app, "--reflectance", scene.reflectance, reflectance_range,
                 "what a material reflects, 0 to 1; * for all; repeatable")
        ->group("Scene");
}

void add_memory_option(CLI::App& app, SceneSettings& scene) {
    add_parsed(
        app, "--memory", "BYTES", "stop before a scene needs more; k, M, G or T may follow",
        "a number of bytes such as 800M or 1.5G",
        [](const std::string& text) { return parse_bytes(text); },
        [&scene](std::uint64_t bytes) { scene.memory = bytes; })
        ->group("Scene");
}

void add_division_options(CLI::App& app, SolveOptions& options) {
    add_whole<int>(app, "--depth", options.depth, 0, 5, "levels of subdivision of hemispheres [2]")
        ->group("Method");
    add_number(app, "--threshold", "X", options.threshold, non_negative,
               "divide a triangle whose mean density is above X [0]")
        ->group("Method");
}

void add_random_options(CLI::App& app, SolveOptions& options) {
    add_whole<std::uint64_t>(app, "--seed", options.seed, 0,
                             std::numeric_limits<std::uint64_t>::max(), "of the random numbers [1]")
        ->group("Method");
    add_whole<unsigned>(app, "-t,--threads", options.threads, 0, 1024,
                        "0: one per core; the result does not depend on it [0]")
        ->group("Method");
}

void add_camera_options(CLI::App& app, ViewSettings& view) {
    add_parsed(app, "--camera", "EX,EY,EZ,TX,TY,TZ[,FOV]",
               "eye, target and vertical angle of view in degrees [automatic]",
               "ex,ey,ez,tx,ty,tz or ex,ey,ez,tx,ty,tz,fov with two different points and an angle "
               "between 0 and 180 degrees",
               camera_from, [&view](const Camera& value) { view.camera = value; })
        ->group(output_group);
    add_parsed(
        app, "--size", "WxH", "of pictures, in pixels [800x600]",
        "a width and a height from 1 to 16384, such as 800x600",
        [](const std::string& text) { return parse_size(text); },
        [&view](const PixelSize& size) { view.size = size; })
        ->group(output_group);
}

void add_view_options(CLI::App& app, ViewSettings& view) {
    add_camera_options(app, view);
    add_number(app, "--exposure", "X", view.exposure, positive,
               "factor on the light of .png pictures [automatic]")
        ->group(output_group);
}

void add_talk_options(CLI::App& app, Talk& talk) {
    const auto set = [&talk](Talk value) {
        return [&talk, value] {
            if (talk != Talk::normal)
                throw UsageError("-q and -v contradict each other");
            talk = value;
        };
    };
    const std::string group = "Talk";
    app.add_flag_callback("-q,--quiet", set(Talk::quiet), "say nothing but errors")->group(group);
    app.add_flag_callback("-v,--verbose", set(Talk::verbose), "a line per step, and details")
        ->group(group);
    app.set_version_flag("--version", "hemilux " HEMILUX_VERSION, "print the version")
        ->group(group);
    app.set_help_flag(); // so that it stands last
    app.set_help_flag("-h,--help", "print this")->group(group);
}

} // namespace hemilux
