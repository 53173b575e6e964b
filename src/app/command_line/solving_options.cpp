#include "app/command_line/solving_options.h"

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"

#include <algorithm>

namespace hemilux {

void add_method_options(Command command, SolveOptions& options) {
    add_number(command, "--rays", "N", options.rays, {.low = 0, .high = 1e9, .low_included = false},
               "mean rays per patch and step [64]");
    add_division_options(command, options);
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
