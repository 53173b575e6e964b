#include "app/command_line/options.h"

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace hemilux {

namespace {

constexpr std::string_view default_method = "gathering";
/// Taken where one of its own options is given and no --method.
constexpr std::string_view method_of_division = "hemisphere";
constexpr auto division_options =
    std::to_array<const char*>({"--depth", "--threshold", "--guide", "--literal"});
constexpr const char* comparison_group = "Comparison";

/// The method named, or UsageError with the nearest name.
const Method* method_by_name(std::string_view name) {
    if (const Method* const method = find_method(name))
        return method;
    std::vector<std::string> names;
    for (const Method* const method : methods())
        names.emplace_back(method->name);
    throw UsageError("--method: " + unknown_name("method", name, names));
}

void add_method_option(CLI::App& app, const Method*& method) {
    method = find_method(default_method);
    app.add_option_function<std::string>(
           "--method", [&method](const std::string& name) { method = method_by_name(name); },
           "how to solve, see below [" + std::string(default_method) + "; " +
               std::string(method_of_division) +
               " where --depth, --threshold, --guide or --literal are given]")
        ->type_name("NAME")
        ->group("Method");
    app.parse_complete_callback([&app, &method] {
        const auto given = [&app](const char* name) { return app.count(name) > 0; };
        if (!given("--method") && std::ranges::any_of(division_options, given))
            method = find_method(method_of_division);
    });
}

/// All that --methods may name.
std::vector<Entrant> possible_entrants() {
    std::vector<Entrant> list;
    for (const Method* const method : methods()) {
        list.push_back({std::string(method->name), method, {}});
        if (method->name == method_of_division) {
            list.push_back({list.back().name + "-visible", method, Guide::visible});
            list.push_back({std::string(method->name) + "-learned", method, Guide::learned});
        }
    }
    return list;
}

Entrant entrant_by_name(std::string_view name) {
    std::vector<std::string> names;
    for (const Entrant& entrant : possible_entrants()) {
        if (entrant.name == name)
            return entrant;
        names.push_back(entrant.name);
    }
    throw UsageError("--methods: " + unknown_name("method", name, names));
}

/// Names with commas between them.
std::vector<Entrant> entrants_from(std::string_view text) {
    std::vector<Entrant> list;
    for (bool more = true; more;) {
        const std::size_t comma = text.find(',');
        list.push_back(entrant_by_name(text.substr(0, comma)));
        if (std::ranges::count(list, list.back().name, &Entrant::name) > 1)
            throw UsageError("--methods: '" + list.back().name + "' is named twice");
        more = comma != std::string_view::npos;
        if (more)
            text.remove_prefix(comma + 1);
    }
    return list;
}

void add_methods_option(CLI::App& app, std::vector<Entrant>& list) {
    for (const Entrant& entrant : possible_entrants())
        if ((entrant.method->unbiased || entrant.name == default_method) && !entrant.guide)
            list.push_back(entrant);
    app.add_option_function<std::string>(
           "--methods", [&list](const std::string& text) { list = entrants_from(text); },
           "what to compare, see below; also hemisphere-visible, hemisphere-learned [" +
               std::string(default_method) + " and all that are unbiased]")
        ->type_name("NAME,NAME,...")
        ->group("Method");
}

void add_method_options(CLI::App& app, SolveOptions& options) {
    add_number(app, "--rays", "N", options.rays, {.low = 0, .high = 1e9, .low_included = false},
               "mean rays per patch and step [64]")
        ->group("Method");
    add_division_options(app, options);
    app.add_option_function<std::string>(
           "--guide",
           [&options](const std::string& name) {
               const auto found = std::ranges::find(guide_names, name);
               if (found == guide_names.end()) {
                   const std::vector<std::string> names(guide_names.begin(), guide_names.end());
                   throw UsageError("--guide: " + unknown_name("guide", name, names));
               }
               options.guide = static_cast<Guide>(found - guide_names.begin());
           },
           "what guides hemisphere: density, visible or learned [density]")
        ->type_name("NAME")
        ->group("Method");
    app.add_flag("--literal", options.literal, "the paper's rules as printed; they are biased")
        ->group("Method");
    app.add_flag("--keep-all", options.keep_all,
                 "leave out nothing that the scene does not need (see hemilux info)")
        ->group("Method");
    add_random_options(app, options);
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
    add_whole<std::uint64_t>(
        app, "--max-rays", stop.rays, 1, std::numeric_limits<std::uint64_t>::max(),
        "after N rays, even if the error is not reached [1e8 and 1000 a patch]")
        ->group(group);
}

void add_output_options(CLI::App& app, SolveSettings& settings) {
    repeatable(add_parsed(
                   app, "-o,--output", "FILE",
                   "picture .png .hdr, mesh .ply, patches .csv, statistics .json; "
                   "repeatable",
                   "a file name that ends with .png, .hdr, .ply, .csv or .json",
                   [](const std::string& path) { return parse_output(path); },
                   [&settings](const Output& value) { settings.outputs.push_back(value); }))
        ->group(output_group);
    add_text(app, "--stats", "FILE", settings.statistics, "statistics of the run as JSON")
        ->group(output_group);
    add_text(app, "--steps-log", "FILE", settings.steps_log, "a CSV row per step")
        ->group(output_group);
    app.add_flag("--every-step", settings.every_step,
                 "also write the pictures after every step, as NAME-0001.png and so on")
        ->group(output_group);
    add_view_options(app, settings.view);
}

void add_checkpoint_options(CLI::App& app, CheckpointSettings& checkpoint) {
    const std::string group = "Checkpoints";
    add_text(app, "--checkpoint", "FILE", checkpoint.path,
             "keep what was computed in a file, after steps and at the end")
        ->group(group);
    add_number(app, "--every", "SECONDS", checkpoint.every, non_negative,
               "of the time between two checkpoints; 0: after each step [60]")
        ->group(group);
    add_text(app, "--resume", "FILE", checkpoint.resumed,
             "go on from a checkpoint: the same scene and method, the same bytes in the end")
        ->group(group);
}

void add_detail_option(CLI::App& app, std::vector<std::string>& detail) {
    repeatable(app.add_option("--detail", detail,
                              "groups whose error is also reported apart [detail...]; "
                              "repeatable"))
        ->type_name("GROUP")
        ->group(comparison_group);
}

void add_comparison_options(CLI::App& app, SolveSettings& settings) {
    add_text(app, "--reference", "FILE.csv", settings.reference,
             "patch table of the same patches: report the true error")
        ->group(comparison_group);
    add_detail_option(app, settings.detail);
}

void add_budget_options(CLI::App& app, CompareSettings& settings) {
    const std::string group = "Budget of each run of each method, one of the two";
    CLI::Option* const rays = add_number(app, "--budget-rays", "N", settings.budget.rays, positive,
                                         "rays, density rays included [64 steps]");
    CLI::Option* const seconds =
        add_number(app, "--budget-time", "SECONDS", settings.budget.seconds, positive,
                   "its own time, preprocessing included");
    rays->group(group);
    seconds->group(group)->excludes(rays);
    add_whole<std::uint32_t>(app, "--runs", settings.runs, 1, 1000,
                             "runs of each method, with seeds that follow each other [3]")
        ->group(group);
}

void add_reference_options(CLI::App& app, CompareSettings& settings) {
    app.add_option_function<std::string>(
           "--reference",
           [&settings](const std::string& text) {
               settings.reference = text == "matrix" ? std::string() : text;
           },
           "what is taken for the truth: a patch table, or the matrix method [matrix]")
        ->type_name("FILE.csv|matrix")
        ->group(comparison_group);
    add_number(app, "--reference-error", "X", settings.reference_error, positive,
               "estimated relative error of the matrix method [.002]")
        ->group(comparison_group);
    add_detail_option(app, settings.detail);
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
  hemilux solve room.obj --steps 999 -o room.csv --checkpoint room.saved
  hemilux solve room.obj --steps 999 -o room.csv --checkpoint room.saved --resume room.saved
)";

constexpr const char* compare_examples = R"(
Examples:
  hemilux compare room.obj -o compared
  hemilux compare room.obj -o compared --methods hemisphere,stratified --budget-time 10
  hemilux compare room.obj -o again --reference compared/reference.csv --literal
)";

constexpr const char* info_examples = R"(Examples:
  hemilux info room.obj
  hemilux info room.obj --max-edge .1
)";

constexpr const char* exit_codes = R"(
Exit codes: 0 done, 1 wrong usage, 2 bad input, 3 output or system failure,
130 interrupted by Ctrl-C and 143 by SIGTERM (what was computed has been written).)";

} // namespace

CLI::App* add_solve_command(CLI::App& program, SolveSettings& settings) {
    CLI::App* const app = program.add_subcommand("solve", "solve a scene, write the results");
    add_scene_options(*app, settings.scene);
    add_memory_option(*app, settings.scene);
    add_method_option(*app, settings.method);
    add_method_options(*app, settings.options);
    add_plain_option(*app, settings.plain);
    add_own_options(*app, settings.options);
    add_stop_options(*app, settings.stop);
    add_output_options(*app, settings);
    add_checkpoint_options(*app, settings.checkpoint);
    add_comparison_options(*app, settings);
    add_talk_options(*app, settings.talk);
    app->footer(methods_text() + solve_examples + exit_codes);
    return app;
}

CLI::App* add_compare_command(CLI::App& program, CompareSettings& settings) {
    CLI::App* const app = program.add_subcommand(
        "compare", "error against run time of several methods, side by side");
    add_scene_options(*app, settings.scene);
    add_memory_option(*app, settings.scene);
    add_methods_option(*app, settings.entrants);
    add_method_options(*app, settings.options);
    add_own_options(*app, settings.options);
    add_budget_options(*app, settings);
    add_reference_options(*app, settings);
    add_text(*app, "-o,--output", "DIR", settings.folder,
             "folder, made where it is not there: error.csv, error.svg, reference.csv, "
             "reference.png and two pictures per method")
        ->required()
        ->group(output_group);
    add_view_options(*app, settings.view);
    add_talk_options(*app, settings.talk);
    app->footer(methods_text() + compare_examples + exit_codes);
    return app;
}

CLI::App* add_info_command(CLI::App& program, InfoSettings& settings) {
    CLI::App* const app = program.add_subcommand(
        "info", "what was read from a scene, what is doubtful in it, what it does not need");
    add_scene_options(*app, settings.scene);
    add_talk_options(*app, settings.talk);
    app->footer(std::string(info_examples) + exit_codes);
    return app;
}

} // namespace hemilux
