// The options of `hemilux compare`.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace hemilux {

namespace {

/// Returns all that --methods may name.
std::vector<MethodVariant> possible_variants() {
    std::vector<MethodVariant> list;
    for (const Method* const method : methods()) {
        list.push_back({std::string(method->name), method, {}, {}});
        for (const MethodOption& own : method->own_options())
            for (const std::string& value : own.values)
                if (own.makes_variants && value != own.get(SolveOptions{}))
                    list.push_back(
                        {std::string(method->name) + "-" + value, method, own.name, value});
    }
    return list;
}

MethodVariant variant_by_name(std::string_view name) {
    std::vector<std::string> names;
    for (const MethodVariant& variant : possible_variants()) {
        if (variant.name == name)
            return variant;
        if (variant.value.empty() && variant.method == find_method(name))
            return {std::string(name), variant.method, {}, {}}; // results call it as the user does
        names.push_back(variant.name);
    }
    throw UsageError("--methods: " + unknown_name("method", name, names));
}

/// Reads names with commas between them.
std::vector<MethodVariant> variants_from(std::string_view text) {
    std::vector<MethodVariant> list;
    for (const std::string_view name : parts_of(text, ',')) {
        MethodVariant variant = variant_by_name(name);
        if (std::ranges::any_of(list, [&variant](const MethodVariant& other) {
                return other.method == variant.method && other.value == variant.value;
            }))
            throw UsageError("--methods: '" + variant.name + "' is named twice");
        list.push_back(std::move(variant));
    }
    return list;
}

void add_methods_option(Command command, std::vector<MethodVariant>& list) {
    std::vector<std::string> with_values;
    for (const MethodVariant& variant : possible_variants())
        if (!variant.value.empty())
            with_values.push_back(variant.name);
        else if (variant.method->unbiased || variant.method->role == Role::standard)
            list.push_back(variant);
    command.add_value("--methods", "METHOD,METHOD,...",
                      "what to compare, see below; also " + joined(with_values, ", ") + " [" +
                          std::string(method_of(Role::standard).name) +
                          " and all that are unbiased]",
                      [&list](const std::string& text) { list = variants_from(text); });
}

void add_budget_options(Command command, CompareSettings& settings) {
    const Option rays = add_number(command, "--budget-rays", "N", settings.budget.rays, positive,
                                   "rays, density rays included [64 steps]");
    add_seconds(command, "--budget-time", settings.budget.seconds, positive,
                "its own time, preprocessing included")
        .excludes(rays);
    add_whole<std::uint32_t>(command, "--runs", settings.runs, 1, 1000,
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
    add_detail_option(command, settings.detail);
}

constexpr const char* compare_examples = R"(
Examples:
  hemilux compare room.obj -o compared
  hemilux compare room.obj -o compared --methods hemisphere,stratified --budget-time 10
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
    add_method_options(method, settings.options);
    add_own_options(command.under(own_group), methods(), settings.options);
    add_budget_options(command.under("Budget of each run of each method, one of the two"),
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
    command.end_help_with(methods_text() + compare_examples + exit_codes);
    return command;
}

} // namespace hemilux
