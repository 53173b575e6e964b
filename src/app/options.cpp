#include "app/options.h"

#include "app/exit_code.h"
#include "app/names.h"
#include "app/option_kinds.h"

#include <limits>

namespace hemilux {

namespace {

constexpr std::string_view default_method = "hemisphere";

CLI::Option* add_override(CLI::App& app, const std::string& name, std::vector<Override>& list,
                          const NumberRange& range, const std::string& help) {
    const auto parse = [range](const std::string& text) { return parse_override(text, range); };
    return repeatable(add_parsed(app, name, "MATERIAL=R,G,B", help,
                                 "MATERIAL=R,G,B or MATERIAL=GREY with numbers " + range.text(),
                                 parse, [&list](const Override& value) { list.push_back(value); }));
}

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& type,
                      std::string& target, const std::string& help) {
    return app.add_option(name, target, help)->type_name(type);
}

void add_scene_options(CLI::App& app, SceneSettings& scene) {
    add_text(app, "SCENE", "FILE", scene.path, "the scene: Wavefront .obj")->required();
    add_number(app, "--max-edge", "LENGTH", scene.mesh.max_edge, positive,
               "divide faces until no edge is longer [not divided]")
        ->group("Scene");
    app.add_flag("--two-sided", scene.mesh.two_sided, "faces emit and reflect on both sides")
        ->group("Scene");
    add_override(app, "--emission", scene.emission, emission_range,
                 "what a material emits, W/m2; * for all; repeatable")
        ->group("Scene");
    add_override(app, "--reflectance", scene.reflectance, reflectance_range,
                 "what a material reflects, 0 to below 1; * for all; repeatable")
        ->group("Scene");
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

void add_method_options(CLI::App& app, SolveSettings& settings) {
    SolveOptions& options = settings.options;
    app.add_option_function<std::string>(
           "--method",
           [&settings](const std::string& name) { settings.method = method_by_name(name); },
           "how to solve, see below [" + std::string(default_method) + "]")
        ->type_name("NAME")
        ->group("Method");
    add_number(app, "--rays", "N", options.rays, {.low = 0, .high = 1e9, .low_included = false},
               "mean rays per patch and step [64]")
        ->group("Method");
    add_whole<int>(app, "--depth", options.depth, 0, 5, "levels of subdivision of hemispheres [2]")
        ->group("Method");
    add_number(app, "--threshold", "X", options.threshold, non_negative,
               "divide a triangle whose mean density is above X [0]")
        ->group("Method");
    app.add_flag("--literal", options.literal, "the paper's rules as printed; they are biased")
        ->group("Method");
    add_whole<std::uint64_t>(app, "--seed", options.seed, 0,
                             std::numeric_limits<std::uint64_t>::max(), "of the random numbers [1]")
        ->group("Method");
    add_whole<unsigned>(app, "-t,--threads", options.threads, 0, 1024,
                        "0: one per core; the result does not depend on it [0]")
        ->group("Method");
}

void add_stop_options(CLI::App& app, StopRule& stop) {
    const std::string group = "Stop at the first that is met";
    add_whole<std::uint32_t>(app, "--steps", stop.steps, 1,
                             std::numeric_limits<std::uint32_t>::max(), "after N steps")
        ->group(group);
    add_number(app, "--time", "SECONDS", stop.seconds, positive, "after a time of solving")
        ->group(group);
    add_number(app, "--error", "X", stop.error, positive,
               "at an estimated relative error, e.g. .01")
        ->group(group);
}

std::optional<Camera> camera_from(const std::string& text) {
    try {
        const Camera camera = parse_camera(text);
        return camera.eye != camera.target ? std::optional(camera) : std::nullopt;
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

void add_output_options(CLI::App& app, SolveSettings& settings) {
    const std::string group = "Outputs";
    repeatable(add_parsed(
                   app, "-o,--output", "FILE",
                   "picture .png .hdr, mesh .ply, patches .csv, statistics .json; "
                   "repeatable",
                   "a file name that ends with .png, .hdr, .ply, .csv or .json",
                   [](const std::string& path) { return parse_output(path); },
                   [&settings](const Output& value) { settings.outputs.push_back(value); }))
        ->group(group);
    add_text(app, "--stats", "FILE", settings.statistics, "statistics of the run as JSON")
        ->group(group);
    add_text(app, "--steps-log", "FILE", settings.steps_log, "a CSV row per step")->group(group);
    add_parsed(app, "--camera", "EX,EY,EZ,TX,TY,TZ[,FOV]",
               "eye, target and vertical angle of view in degrees [automatic]",
               "ex,ey,ez,tx,ty,tz or ex,ey,ez,tx,ty,tz,fov with two different points and an angle "
               "between 0 and 180 degrees",
               camera_from, [&settings](const Camera& value) { settings.view.camera = value; })
        ->group(group);
    add_parsed(
        app, "--size", "WxH", "of pictures, in pixels [800x600]",
        "a width and a height from 1 to 16384, such as 800x600",
        [](const std::string& text) { return parse_size(text); },
        [&settings](const PixelSize& size) { settings.view.size = size; })
        ->group(group);
    add_number(app, "--exposure", "X", settings.view.exposure, positive,
               "factor on the light of .png pictures [automatic]")
        ->group(group);
}

void add_comparison_options(CLI::App& app, SolveSettings& settings) {
    const std::string group = "Comparison";
    add_text(app, "--reference", "FILE.csv", settings.reference,
             "patch table of the same patches: report the true error")
        ->group(group);
    repeatable(app.add_option("--detail", settings.detail,
                              "groups whose error is also reported apart [detail...]; "
                              "repeatable"))
        ->type_name("GROUP")
        ->group(group);
}

std::string methods_text() {
    std::string text = "Methods:\n";
    for (const Method* const method : methods()) {
        std::string name(method->name);
        name.resize(std::max<std::size_t>(name.size() + 2, 26), ' ');
        text += "  " + name + std::string(method->summary) + "\n";
    }
    return text;
}

constexpr const char* solve_examples = R"(
Examples:
  hemilux solve room.obj -o room.png
  hemilux solve room.obj --max-edge .1 --error .01 -o room.hdr -o room.csv
  hemilux solve map.obj --emission 'Lava=8,2,.3' --reflectance '*=.6' -o map.ply
  hemilux solve room.obj --method matrix -o reference.csv
  hemilux solve room.obj --reference reference.csv --steps-log steps.csv
)";

constexpr const char* info_examples = R"(Examples:
  hemilux info room.obj
  hemilux info room.obj --max-edge .1
)";

constexpr const char* exit_codes = R"(
Exit codes: 0 done, 1 wrong usage, 2 bad input, 3 output or system failure,
130 interrupted (what was computed has been written).)";

} // namespace

const Method* method_by_name(std::string_view name) {
    if (const Method* const method = find_method(name))
        return method;
    std::vector<std::string> names;
    for (const Method* const method : methods())
        names.emplace_back(method->name);
    throw UsageError("--method: " + unknown_name("method", name, names));
}

CLI::App* add_solve_command(CLI::App& program, SolveSettings& settings) {
    CLI::App* const app = program.add_subcommand("solve", "solve a scene, write the results");
    settings.method = find_method(default_method);
    add_scene_options(*app, settings.scene);
    add_method_options(*app, settings);
    add_stop_options(*app, settings.stop);
    add_output_options(*app, settings);
    add_comparison_options(*app, settings);
    add_talk_options(*app, settings.talk);
    app->footer(methods_text() + solve_examples + exit_codes);
    return app;
}

CLI::App* add_info_command(CLI::App& program, InfoSettings& settings) {
    CLI::App* const app =
        program.add_subcommand("info", "what was read from a scene and what is doubtful in it");
    add_scene_options(*app, settings.scene);
    add_talk_options(*app, settings.talk);
    app->footer(std::string(info_examples) + exit_codes);
    return app;
}

} // namespace hemilux
