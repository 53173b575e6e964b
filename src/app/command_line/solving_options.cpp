#include "app/command_line/solving_options.h"

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/settings/method_options.h"
#include "app/settings/names.h"

#include <algorithm>
#include <string_view>

namespace hemilux {

namespace {

/// Names of those that --guide changes.
std::string guided_methods() {
    return names_of_methods([](const Method& method) { return method.guided; });
}

} // namespace

void add_method_options(Command command, SolveOptions& options) {
    add_number(command, "--rays", "N", options.rays, {.low = 0, .high = 1e9, .low_included = false},
               "mean rays per patch and step [64]");
    add_division_options(command, options);
    add_choice(command, "--guide", options.guide, guide_names,
               "what guides " + guided_methods() + " [density]");
    command.add_flag("--literal", options.literal, "the paper's rules as printed; they are biased");
    command.add_flag("--keep-all", options.keep_all,
                     "leave out nothing that the scene does not need (see hemilux info)");
    add_random_options(command, options);
}

void add_detail_option(Command command, std::vector<std::string>& detail) {
    command
        .add_texts("--detail", "GROUP", detail,
                   "groups whose error is also reported apart [detail...]; repeatable")
        .repeatable();
}

/// --factors of `matrix` and so on.
void add_own_options(Command command, SolveOptions& options) {
    add_factor_options(
        command, options.factors,
        {"matrix, progressive: form factors by rays; exact: as --exact; hemicube: by a hemicube "
         "over each patch, N pixels along its edge [rays; N 64]",
         "matrix: factors without chance where patches see each other fully; for small scenes"});
    add_own_numbers(command, methods(), options);
    std::vector<std::string_view> added;
    for (const Method* const method : methods())
        for (const MethodFlag& flag : method->flags) {
            if (std::ranges::find(added, flag.name) != added.end())
                continue; // several methods take it
            command.add_flag(std::string(flag.name), flag.value(options), std::string(flag.help));
            added.push_back(flag.name);
        }
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

} // namespace hemilux
