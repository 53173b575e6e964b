// The options of `hemilux solve`.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>

namespace hemilux {

void add_stop_options(Command command, StopRule& stop) {
    add_whole(command, "--steps", stop.steps, 1, std::numeric_limits<std::uint32_t>::max(),
              "after N steps");
    add_seconds(command, "--time", stop.seconds, positive,
                "after a time of solving, and as long again at --points; as 30, 2m or 1h");
    add_error(
        command, "--error", stop.error,
        "at an estimated relative error, e.g. 1% or 0.01; of pictures and --points when it is "
        "surely below this [0.02 for these]");
    add_whole(command, "--max-rays", stop.rays, 1, std::numeric_limits<std::uint64_t>::max(),
              "after N rays [1e8 and 1000 a patch]");
}

void add_layers_option(Command command, std::optional<LayersBy>& layers) {
    add_choice(
        command, "--layers", layers,
        {{LayersBy::lamp, "lamp"}, {LayersBy::group, "group"}, {LayersBy::material, "material"}},
        "also the light of each lamp, the sun and the sky by itself, in tables, .exr pictures and "
        "--report; lamps are faces that touch, groups or materials; `hemilux dim` gives them other "
        "powers");
}

namespace {

void add_plain_option(Command command, bool& plain) {
    command.add_flag(
        "--plain", plain,
        "by the page of src/radiosity/paper/pages that shows the method: slower, one thread");
}

/// Returns the method named, or throws UsageError with the nearest name.
const Method* method_by_name(std::string_view name) {
    if (const Method* const method = find_method(name))
        return method;
    std::vector<std::string> names;
    for (const Method* const method : methods())
        names.emplace_back(method->name);
    throw UsageError("--method: " + unknown_name("method", name, names));
}

void add_method_option(Command command, const Method*& method) {
    method = &method_of(Role::standard);
    std::string taken(method->name);
    for (const Method* const other : methods())
        if (other->implied_by)
            taken += "; " + std::string(other->name) + " where " +
                     joined(other->implied_by(), ", ", " or ") + " are given";
    command.add_value("--method", "METHOD", "how to solve [" + taken + "]",
                      [&method](const std::string& name) { method = method_by_name(name); });
    command.after_parsing([command, &method] {
        const auto given = [&command](std::string_view name) {
            return command.given(std::string(name));
        };
        if (given("--method"))
            return;
        for (const Method* const other : methods())
            if (other->implied_by && std::ranges::any_of(other->implied_by(), given))
                method = other;
    });
}

void add_error_accuracy_option(Command command, double& accuracy) {
    add_error(command, "--error-accuracy", accuracy,
              "also find the error of gathered light to this share of itself, e.g. 10%");
}

void add_whole_error_option(Command command, SolveSettings& settings) {
    command.add_flag("--whole-error", settings.whole_error,
                     "also find out how far the light within patches is from theirs");
}

void add_output_option(Command command, SolveSettings& settings) {
    add_parsed(
        command, "-o,--output", "FILE",
        "picture .png .hdr .exr, mesh .glb .ply, patches .csv .vtu, statistics .json; repeatable",
        "a file name that ends with .png, .hdr, .exr, .ply, .glb, .vtu, .csv or .json",
        parse_output, settings.outputs);
}

void add_output_options(Command command, SolveSettings& settings) {
    command.add_text("--stats", "FILE", settings.statistics, "statistics of the run as JSON");
    command.add_text("--steps-log", "FILE", settings.steps_log, "a CSV row per step");
    command.add_flag("--every-step", settings.every_step,
                     "also write the pictures after every step, as NAME-0001.png and so on");
    add_choice(command, "--bake", settings.bake,
               {{Bake::radiosity, name_of(Bake::radiosity)},
                {Bake::irradiance, name_of(Bake::irradiance)},
                {Bake::indirect, name_of(Bake::indirect)}},
               "what .glb and .ply files hold: what surfaces send; what arrives, for viewers with "
               "textures of their own; of that what was reflected before [radiosity]");
    add_whole(command, "--lightmap", settings.lightmap, 16, SolveSettings::max_lightmap,
              "beside .glb files the light as a picture NAME.lightmap.exr of N x N texels, for the "
              "texture coordinates TEXCOORD_1");
    add_choice(command, "--ply-colours", settings.ply_colours,
               {{PlyColours::linear, "linear"}, {PlyColours::shown, "shown"}},
               "colours of .ply files: the light as float; 8 bits as pictures show it [linear]");
    add_view_options(command, settings.view);
}

void add_point_options(Command command, SolveSettings& settings) {
    command.add_text(
        "--points", "FILE", settings.points.path,
        "points where the light is to be known: rows x,y,z,nx,ny,nz; without --time or "
        "--max-rays they end after 50 million rays, more for many points");
    command.add_text("--points-output", "FILE", settings.points.output,
                     "CSV table of --points: irradiance, radiosity, standard error");
    add_whole(
        command, "--gather", settings.gather, 1, SolveSettings::max_gather,
        "rays that gather light at a point of a picture, more at edges; at one of --points 256 "
        "times as many [16, or as many as --error needs]");
    command.add_action(
        "--no-gather", [&settings] { settings.gather_pictures = false; },
        "pictures interpolate the light of the patches");
}

/// Adds one thing that --for names.
void add_target(const std::string& text, TargetSettings& target) {
    const std::size_t colon = text.find(':');
    const std::string kind = text.substr(0, colon);
    const std::string name = colon == std::string::npos ? "" : text.substr(colon + 1);
    std::vector<std::string>* const names = kind == "group"    ? &target.groups
                                            : kind == "points" ? &target.points
                                                               : nullptr;
    if (text != "camera" && (!names || name.empty()))
        throw UsageError("--for: expected camera, group:NAME or points:FILE, found '" + text + "'");
    if (names ? std::ranges::find(*names, name) != names->end() : target.camera)
        throw UsageError("--for: '" + text + "' is named twice");
    if (names)
        names->push_back(name);
    else
        target.camera = true;
}

void add_target_option(Command command, TargetSettings& target) {
    command
        .add_values("--for", "camera|group:NAME|points:FILE",
                    "what is to be right to --error, all else may be rough: what --camera shows, a "
                    "group, patches at points; repeatable",
                    [&target](const std::vector<std::string>& texts) {
                        for (const std::string& text : texts)
                            add_target(text, target);
                    })
        .repeatable();
}

void add_error_map_option(Command command, SolveSettings& settings) {
    add_path(command, "--error-map", "FILE.png",
             "picture in false colour of how far the light of each patch is off", ".png",
             settings.error_map);
}

void add_comparison_options(Command command, SolveSettings& settings) {
    command.add_text("--reference", "FILE.csv", settings.reference,
                     "patch table of the same patches: report the true error");
    add_detail_option(command, settings.detail);
}

constexpr const char* solve_examples = R"(
Examples:
  hemilux solve room.obj -o room.png
  hemilux solve room.obj --sky 1 --error 1% -o room.hdr -o room.csv
  hemilux solve room.obj --points desks.txt --points-output desks.csv
  hemilux solve map.obj --emission 'Lava=8,2,0.3' --reflectance '*=0.6' -o map.ply
  hemilux solve room.obj --steps 999 -o room.csv --checkpoint room.saved --resume room.saved
)";

/// The choice of what patches are divided by.
struct DivisionChoice {
    bool by_light = false;
    double max_edge = 0; ///< 0: not divided
};

std::optional<DivisionChoice> division_from(const std::string& text) {
    if (text == "auto")
        return DivisionChoice{.by_light = true};
    if (text == "none")
        return DivisionChoice{};
    const std::optional<double> length = parse_number(text);
    if (!length || !positive.contains(*length))
        return std::nullopt;
    return DivisionChoice{.max_edge = *length};
}

void add_divide_option(Command command, Option max_edge, SolveSettings& settings) {
    add_parsed(
        command, "--divide", "auto|none|LENGTH",
        "divide faces into patches: auto: where light changes, until that of patches is right to "
        "--error [0.05]; none; LENGTH: as --max-edge [auto for small meshes that are written, else "
        "none]",
        "auto, none or a length above 0", division_from,
        [&settings](const DivisionChoice& choice) {
            settings.divide_given = true;
            settings.divide_auto = choice.by_light;
            settings.scene.mesh.max_edge = choice.max_edge;
        })
        .excludes(max_edge);
}

} // namespace

Command add_solve_command(Arguments& program, SolveSettings& settings) {
    const Command command = program.add_command("solve", "solve a scene, write the results");
    const Command scene = command.under(scene_group), method = command.under(method_group),
                  outputs = command.under(output_group);
    add_output_option(outputs, settings);
    const Option max_edge = add_scene_options(command, settings.scene);
    add_divide_option(scene, max_edge, settings);
    add_memory_option(scene, settings.scene);
    add_method_option(method, settings.method);
    const Command own = command.under(own_group);
    add_method_options(method, own, settings.options);
    add_plain_option(own, settings.plain);
    add_own_options(own, methods(), settings.options);
    const Command stop = command.under("Stop at the first that is met");
    add_stop_options(stop, settings.stop);
    stop.add_flag("--useful", settings.useful,
                  "once the picture of the patches looks as one without noise (structural "
                  "similarity of 0.95 at 640 pixels); not gathered then without --gather");
    add_error_accuracy_option(stop, settings.error_accuracy);
    add_whole_error_option(scene, settings);
    add_target_option(stop, settings.target);
    add_output_options(outputs, settings);
    add_point_options(outputs, settings);
    add_layers_option(outputs, settings.layers);
    add_error_map_option(outputs, settings);
    add_report_option(outputs, settings.report,
                      "a page for a browser: the lit scene to turn around, how the run went");
    add_checkpoint_options(stop, settings.checkpoint);
    add_comparison_options(outputs, settings);
    add_verbosity_options(command, settings.verbosity);
    constexpr auto often_used = std::to_array({"--output", "--error", "--time", "--camera",
                                               "--size", "--points", "--divide", "--threads"});
    command.call_often_used(often_used);
    fold_own_options(command);
    command.end_help_with(methods_text() + solve_examples + exit_codes);
    return command;
}

} // namespace hemilux
