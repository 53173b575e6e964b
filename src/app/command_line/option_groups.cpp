#include "app/command_line/option_groups.h"
#include "io/pictures/camera_text.h"
#include "radiosity/answers/images/tone.h"

#include "app/command_line/option_kinds.h"
#include "app/memory/memory.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "radiosity/engine/solving/method_option.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace hemilux {

namespace {

Option add_override(Command command, const std::string& name, std::vector<Override>& list,
                    const NumberRange& range, const std::string& help) {
    const auto parse = [range](const std::string& text) { return parse_override(text, range); };
    return add_parsed(command, name, "MATERIAL=R,G,B", help,
                      "MATERIAL=R,G,B or MATERIAL=GREY with numbers " + range.text(), parse, list);
}

/// A camera, or none for `auto`, and whether it says what is upwards.
struct GivenCamera {
    std::optional<Camera> camera;
    bool has_up;
};

std::optional<GivenCamera> camera_from(const std::string& text) {
    constexpr int commas_with_up = 9;
    if (text == "auto")
        return GivenCamera{};
    if (const std::optional<Camera> camera = parse_camera(text))
        return GivenCamera{camera, std::ranges::count(text, ',') == commas_with_up};
    return std::nullopt;
}

void choose_sides(SceneSettings& scene, Sides sides) {
    scene.sides = sides;
    scene.mesh.two_sided = sides == Sides::both;
}

void add_sides_options(Command command, SceneSettings& scene) {
    const Option sides = add_choice<Sides>(
        command, "--sides",
        {{Sides::automatic, "auto"}, {Sides::front, "front"}, {Sides::both, "both"}},
        "which sides of faces emit and reflect: the front, once those that look away from the "
        "light are turned; the front as in the file; both [auto]",
        [&scene](Sides chosen) { choose_sides(scene, chosen); });
    command
        .add_action(
            "--two-sided", [&scene] { choose_sides(scene, Sides::both); },
            "the same as --sides both")
        .hidden()
        .excludes(sides);
}

void add_light_options(Command command, SceneSettings& scene) {
    add_parsed(
        command, "--light", "TEXT",
        "add a lamp: 'disc at 0,2.4,0 towards 0,-1,0 radius 0.2 watts 60', 'rectangle at P towards "
        "D size 1x0.5 emission 20', 'point at P watts 60', 'spot at P towards D inner 20 outer 30 "
        "intensity 9', 'ies FILE at P towards D'; repeatable",
        light_form, parse_light, scene.lights);
    add_parsed(
        command, "--sun", "X,Y,Z,W",
        "add a sun: where its light goes, and its light on a surface that faces it, W/m2 or R,G,B; "
        "repeatable",
        "X,Y,Z,W or X,Y,Z,R,G,B with a direction that is not 0,0,0", parse_sun, scene.suns);
    add_parsed(
        command, "--sky", "R,G,B", "add a sky that is alike all around, W/m2",
        "R,G,B or one number, " + emission_range.text(),
        [](const std::string& text) { return parse_colour(text, emission_range); }, scene.sky);
}

} // namespace

Option add_scene_options(Command command, SceneSettings& scene) {
    command.add_text("SCENE", "FILE", scene.path, "the scene: .obj, .gltf, .glb, .stl or .vs3")
        .required();
    command = command.under(scene_group);
    command.add_text(
        "--config", "FILE", scene.config,
        "options from a TOML file, as error = \"1%\"; those of the command line come first");
    const Option max_edge =
        add_number(command, "--max-edge", "LENGTH", scene.mesh.max_edge, positive,
                   "divide faces until no edge is longer [not divided]");
    add_sides_options(command, scene);
    add_choice(command, "--glass", scene.glass, {{Glass::open, "open"}, {Glass::solid, "solid"}},
               "glass lets its share of light through and absorbs the rest, or is opaque [solid]");
    command.add_action(
        "--no-textures", [&scene] { scene.textures = false; },
        "leave out the pictures on surfaces");
    command.add_action(
        "--no-outside-files", [&scene] { scene.outside = Outside::refused; },
        "refuse a scene that names files outside its folder");
    add_override(command, "--emission", scene.emission, emission_range,
                 "what a material emits, W/m2; * in its name stands for any letters; repeatable");
    add_override(command, "--reflectance", scene.reflectance, reflectance_range,
                 "what a material reflects, 0 to 1; * as above; repeatable");
    add_light_options(command, scene);
    return max_edge;
}

void add_geometry_options(Command command, SceneSettings& scene) {
    command.add_text("SCENE", "FILE", scene.path, "the scene: .obj, .gltf, .glb, .stl or .vs3")
        .required();
    scene.textures = false;
    command = command.under(scene_group);
    command.add_text(
        "--config", "FILE", scene.config,
        "options from a TOML file, as error = \"1%\"; those of the command line come first");
    add_number(command, "--max-edge", "LENGTH", scene.mesh.max_edge, positive,
               "divide faces until no edge is longer; rows stay whole [not divided]");
    add_choice<Sides>(
        command, "--sides",
        {{Sides::automatic, "auto"}, {Sides::front, "front"}, {Sides::both, "both"}},
        "which sides of faces see: both of those that the file calls double-sided, else the front; "
        "the front of all; both of all [auto]",
        [&scene](Sides chosen) { choose_sides(scene, chosen); });
}

void add_memory_option(Command command, SceneSettings& scene) {
    add_parsed(command, "--memory", "BYTES", "stop before a scene needs more, as 800M or 2G",
               "a number of bytes such as 800M or 1.5G", parse_bytes, scene.memory);
}

void add_division_options(Command command, SolveOptions& options) {
    add_whole(command, "--depth", options.depth, 0, 5, "levels of subdivision of hemispheres [2]");
    add_number(command, "--threshold", "X", options.threshold, non_negative,
               "divide a triangle whose mean density is above X [0]");
}

namespace {

Option add_own_option(Command command, const MethodOption& own, const std::string& help,
                      SolveOptions& options) {
    if (own.values.empty())
        return command.add_action(
            own.name, [own, &options] { own.set(options, "yes"); }, help);
    return command.add_value(
        own.name, joined(own.values, "|"), help, [own, &options](const std::string& text) {
            const auto refuse = [&](const std::string& expected) {
                throw UsageError(own.name + ": expected " + expected + ", not '" + text + "'");
            };
            try {
                if (!own.set(options, text))
                    refuse(joined(own.values, ", ", " or "));
            } catch (const std::invalid_argument& error) {
                refuse(error.what());
            }
        });
}

} // namespace

void add_own_options(Command command, std::span<const Method* const> methods,
                     SolveOptions& options) {
    std::map<std::string, Option> added;
    std::vector<std::pair<std::string, std::string>> excluding;
    for (const Method* const method : methods)
        for (const MethodOption& own : method->own_options()) {
            if (added.contains(own.name)) // several methods have it
                continue;
            std::vector<std::string_view> names;
            for (const Method* const other : methods)
                if (std::ranges::count(other->own_options(), own.name, &MethodOption::name) > 0)
                    names.push_back(other->name);
            const std::string help =
                methods.size() > 1 ? joined(names, ", ") + ": " + own.help : own.help;
            const Option option = add_own_option(command, own, help, options);
            added.emplace(own.name, is_alias(own) ? option.hidden() : option);
            if (!own.excludes.empty())
                excluding.emplace_back(own.name, own.excludes);
        }
    for (const auto& [one, other] : excluding)
        static_cast<void>(added.at(one).excludes(added.at(other)));
}

bool is_alias(const MethodOption& option) { return option.name == "--exact"; }

void add_random_options(Command command, SolveOptions& options) {
    add_whole(command, "--seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max(),
              "of the random numbers [1]");
    add_whole(command, "-t,--threads", options.threads, 0, 1024,
              "0: one per core, with the same result [0]");
}

void add_checkpoint_options(Command command, CheckpointSettings& checkpoint) {
    command.add_text("--checkpoint", "FILE", checkpoint.path,
                     "keep what was computed, meanwhile and at the end");
    add_seconds(command, "--every", checkpoint.every, non_negative,
                "of the time between two checkpoints; 0: as often as there is more [60]");
    command.add_text(
        "--resume", "FILE", checkpoint.resumed,
        "go on from a checkpoint: the same scene and method, the same bytes in the end");
}

void add_camera_options(Command command, ViewSettings& view) {
    add_parsed(
        command, "--camera", "EX,EY,EZ,TX,TY,TZ[,FOV[,UX,UY,UZ]]",
        "eye, target, vertical angle of view in degrees, direction upwards; auto: the program "
        "chooses it [that of the scene, else auto]",
        "auto or ex,ey,ez,tx,ty,tz[,fov[,ux,uy,uz]] with two different points, an angle "
        "between 0 and 180 degrees and a direction that is not 0,0,0",
        camera_from, [&view](const GivenCamera& value) {
            view.camera = value.camera;
            view.camera_has_up = value.has_up;
            view.uses_camera_of_scene = false;
        });
    command.add_value("--up", "y|z", "axis upwards [guessed; y of .gltf and .glb]",
                      [&view](const std::string& axis) {
                          if (axis != "y" && axis != "z")
                              throw UsageError("--up: expected y or z, not '" + axis + "'");
                          view.up = axis == "y" ? 1 : 2;
                      });
    add_parsed(command, "--size", "WxH", "of pictures, in pixels [800x600]",
               "a width and a height from 1 to 16384, such as 800x600", parse_size, view.size);
}

void add_exposure_options(Command command, ViewSettings& view) {
    add_parsed(command, "--exposure", "X|STOPSev",
               "factor on the light of .png pictures; as +1.5ev in stops from the automatic one "
               "[automatic]",
               "a number above 0, or stops from -100 to 100 such as +1.5ev", parse_exposure,
               [&view](const Exposure& value) {
                   view.exposure = value.factor;
                   view.stops = value.stops;
               });
    add_choice(command, "--tone", view.tone, {{Tone::neutral, "neutral"}, {Tone::srgb, "srgb"}},
               "bright light in .png pictures is compressed, with its hue; or cut at 1 [neutral]");
}

void add_view_options(Command command, ViewSettings& view) {
    add_camera_options(command, view);
    add_exposure_options(command, view);
}

void add_report_option(Command command, std::string& report, const char* contents) {
    add_path(command, "--report", "FILE.html", contents, ".html", report);
}

void add_verbosity_options(Command command, Verbosity& verbosity) {
    command = command.under("Verbosity");
    const Option quiet = command.add_action(
        "-q,--quiet", [&verbosity] { verbosity = Verbosity::quiet; }, "say nothing but errors");
    command
        .add_action(
            "-v,--verbose", [&verbosity] { verbosity = Verbosity::verbose; },
            "a line per step, and details")
        .excludes(quiet);
    command.add_version("--version", "hemilux " HEMILUX_VERSION, "print the version");
    command.add_help("print this");
}

} // namespace hemilux
