// The options of `hemilux compare`.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/settings/exit_code.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"
#include "io/files/text_words.h"
#include "radiosity/engine/solving/method_option.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hemilux {

namespace {

/// Returns all that --methods may name.
std::vector<MethodVariant> possible_variants() {
    std::vector<MethodVariant> list;
    for (const Method* const method : methods()) {
        list.push_back({std::string(method->name), method});
        for (const MethodOption& own : method->own_options())
            for (const std::string& value : own.values)
                if (own.makes_variants && value != own.get(SolveOptions{}))
                    list.push_back(
                        {std::string(method->name) + "-" + value, method, {{own.name, value}}});
    }
    return list;
}

MethodVariant variant_by_name(std::string_view name) {
    std::vector<std::string> names;
    for (const MethodVariant& variant : possible_variants()) {
        if (variant.name == name)
            return variant;
        if (variant.settings.empty() && variant.method == find_method(name))
            return {std::string(name), variant.method}; // results call it as the user does
        names.push_back(variant.name);
    }
    throw UsageError("--methods: " + unknown_name("method", name, names));
}

/// Returns what may stand behind METHOD: in --methods, without dashes.
std::vector<std::string> settable_options(const Method& method) {
    std::vector<std::string> names{"rays"};
    if (method.has_depth)
        names.insert(names.end(), {"depth", "threshold"});
    for (const MethodOption& own : method.own_options())
        names.push_back(own.name.substr(2));
    return names;
}

/// Adds NAME=VALUE, or NAME for a flag.
void add_setting(MethodVariant& variant, const std::string& text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string option = text.substr(0, equals);
    const std::string value = equals < text.size() ? text.substr(equals + 1) : "yes";
    const std::vector<std::string> names = settable_options(*variant.method);
    if (std::ranges::find(names, option) == names.end())
        throw UsageError("--methods: " + std::string(variant.method->name) + ": " +
                         unknown_name("option", option, names));
    SolveOptions ignored;
    bool is_taken = false;
    try {
        is_taken = set_option(*variant.method, "--" + option, value, ignored);
    } catch (const std::invalid_argument& error) {
        throw UsageError("--methods: " + option + ": " + error.what());
    }
    if (!is_taken)
        throw UsageError("--methods: " + std::string(variant.method->name) + " takes no " + option +
                         "=" + value);
    variant.settings.push_back({"--" + option, value});
}

/// Reads METHOD or METHOD:NAME=VALUE:NAME=VALUE; a value may have colons.
MethodVariant variant_from(std::string_view text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    MethodVariant variant = variant_by_name(text.substr(0, colon));
    variant.name = text;
    if (colon == text.size())
        return variant;
    std::vector<std::string> settings;
    for (const std::string_view part : parts_of(text.substr(colon + 1), ':'))
        if (part.find('=') == std::string_view::npos && !settings.empty() &&
            settings.back().find('=') != std::string::npos)
            settings.back() += ":" + std::string(part);
        else
            settings.emplace_back(part);
    for (const std::string& setting : settings)
        add_setting(variant, setting);
    return variant;
}

/// Reads names with commas between them.
std::vector<MethodVariant> variants_from(std::string_view text) {
    std::vector<MethodVariant> list;
    for (const std::string_view name : parts_of(text, ',')) {
        MethodVariant variant = variant_from(name);
        if (std::ranges::any_of(list, [&variant](const MethodVariant& other) {
                return (other.method == variant.method && other.settings == variant.settings) ||
                       other.file_name() == variant.file_name();
            }))
            throw UsageError("--methods: '" + variant.name + "' is named twice");
        list.push_back(std::move(variant));
    }
    return list;
}

void add_methods_option(Command command, std::vector<MethodVariant>& list) {
    std::vector<std::string> with_values;
    for (const MethodVariant& variant : possible_variants())
        if (!variant.settings.empty())
            with_values.push_back(variant.name);
        else if (variant.method->unbiased || variant.method->role == Role::standard)
            list.push_back(variant);
    command.add_value("--methods", "METHOD,METHOD,...",
                      "what to compare, see below; also " + joined(with_values, ", ") +
                          "; METHOD:NAME=VALUE with options of its own, as hemisphere:depth=3, and "
                          "so a method several times [" +
                          std::string(method_of(Role::standard).name) +
                          " and all that are unbiased]",
                      [&list](const std::string& text) { list = variants_from(text); });
}

void add_budget_options(Command command, CompareSettings& settings) {
    const Option rays = add_number(command, "--budget-rays", "N", settings.budget.rays, positive,
                                   "rays, density rays included [64 steps]");
    const Option time = add_seconds(command, "--budget-time", settings.budget.seconds, positive,
                                    "its own time, preprocessing included");
    time.excludes(rays);
    const Option error =
        add_error(command, "--budget-error", settings.budget.error,
                  "until its true error is this, by the reference; rays and seconds then compare "
                  "at equal error");
    error.excludes(rays);
    error.excludes(time);
    add_whole(command, "--runs", settings.runs, 1, 1000,
              "runs of each method, with seeds that follow each other [3]");
}

void add_reference_options(Command command, CompareSettings& settings) {
    const std::string method(method_of(Role::reference).name);
    command.add_value("--reference", "FILE.csv|" + method,
                      "what is taken for the truth: a patch table, or the " + method + " method [" +
                          method + "]",
                      [&settings, method](const std::string& text) {
                          settings.reference = text == method ? std::string() : text;
                      });
    add_error(command, "--reference-error", settings.reference_error,
              "estimated relative error of the " + method + " method [0.002]");
    command.add_flag("--total", settings.total,
                     "curves and gains by the error of the light itself: also that a patch has one "
                     "value; the table has both errors");
    command.add_flag("--relative-mse", settings.relative_mse,
                     "also relMSE: the mean over area and channels of the squared error over the "
                     "square of the reference and a hundredth of that of its mean");
    add_detail_option(command, settings.detail);
}

constexpr const char* compare_examples = R"(
Examples:
  hemilux compare room.obj -o compared
  hemilux compare room.obj -o compared --methods hemisphere,stratified --budget-time 10
  hemilux compare room.obj -o depths --methods hemisphere:depth=2,hemisphere:depth=3
  hemilux compare room.obj -o equal --budget-error 2% --relative-mse
  hemilux compare room.obj -o again --reference compared/reference.csv --literal
)";

} // namespace

Command add_compare_command(Arguments& program, CompareSettings& settings) {
    const Command command =
        program.add_command("compare", "error against run time of several methods, side by side");
    const Command method = command.under(method_group), outputs = command.under(output_group);
    add_scene_options(command, settings.scene);
    add_memory_option(command.under(scene_group), settings.scene);
    add_methods_option(method, settings.variants);
    add_method_options(method, command.under(own_group), settings.options);
    add_own_options(command.under(own_group), methods(), settings.options);
    add_budget_options(command.under("Budget of each run of each method, one of the three"),
                       settings);
    add_reference_options(command.under(comparison_group), settings);
    outputs
        .add_text("-o,--output", "DIR", settings.folder,
                  "folder, made where it is not there: error.csv, error.svg, reference.csv, "
                  "reference.png and two pictures per method")
        .required();
    add_report_option(outputs, settings.report,
                      "a page for a browser: errors as plots and tables, and the light of two "
                      "methods after 1, 2, 4 and more steps side by side, to turn around");
    add_view_options(outputs, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.call_often_used(
        std::to_array({"--output", "--methods", "--budget-rays", "--budget-time", "--budget-error",
                       "--runs", "--report", "--threads"}));
    fold_own_options(command);
    command.end_help_with(methods_text() + compare_examples + exit_codes);
    return command;
}

} // namespace hemilux
