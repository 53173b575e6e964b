#include "app/command_line/solving_options.h"

#include "app/command_line/generated/generated_texts.h"
#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "radiosity/engine/solving/method_option.h"

#include <algorithm>

namespace hemilux {

void add_method_options(Command command, Command own, SolveOptions& options) {
    add_number(command, "--rays", "N", options.rays, {.low = 0, .high = 1e9, .low_included = false},
               "mean rays per patch and step [64]");
    add_division_options(own, options);
    own.add_flag("--literal", options.literal, "the paper's rules as printed; they are biased");
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

void fold_own_options(Command command) {
    command.fold_in_help(own_group, "--help METHOD says what they do");
}

namespace {

/// Returns the names of the options that a method takes and not all do.
std::vector<std::string> options_of(const Method& method) {
    std::vector<std::string> names;
    if (method.has_depth)
        names.insert(names.end(), {"--depth", "--threshold"});
    if (method.has_literal)
        names.emplace_back("--literal");
    if (method.plain)
        names.emplace_back("--plain");
    for (const MethodOption& own : method.own_options())
        if (!is_alias(own))
            names.push_back(own.name);
    return names;
}

std::string text_of(const Method& method, const CommandText& command) {
    std::string text = std::string(method.name) + "\n" + std::string(method.summary) + "\n";
    const std::vector<std::string> names = options_of(method);
    text += names.empty() ? "It has no options of its own.\n" : "\nIts own options:\n";
    for (const std::string& name : names) {
        const auto option = std::ranges::find_if(
            command.options, [&](const OptionText& one) { return one.names.back() == name; });
        if (option == command.options.end())
            continue;
        OptionText of_it = *option;
        for (const MethodOption& own : method.own_options())
            if (own.name == name) { // which says less of it than all methods together
                of_it.help = own.help;
                of_it.type = joined(own.values, "|");
            }
        text += option_line(of_it, of_it.help);
    }
    return help_in_columns(text + "\nhemilux solve --help lists what all methods take.\n");
}

} // namespace

std::optional<std::string> method_help(const std::vector<std::string>& words,
                                       const std::vector<CommandText>& program) {
    const auto help = std::ranges::find(words, "--help");
    if (help == words.end() || help + 1 == words.end() ||
        (words.front() != "solve" && words.front() != "compare"))
        return std::nullopt;
    const std::string& name = *(help + 1);
    if (const Method* const method = find_method(name))
        return text_of(*method, *std::ranges::find(program, words.front(), &CommandText::name));
    if (name.find_first_of("-./") != std::string::npos) // an option or a file
        return std::nullopt;
    std::vector<std::string> names;
    for (const Method* const method : methods())
        names.emplace_back(method->name);
    throw UsageError("--help: " + unknown_name("method", name, names));
}

std::string methods_text() {
    std::string text = "Methods (--help METHOD says what one does):", line = " ";
    constexpr std::size_t width = 80;
    for (const Method* const method : methods()) {
        if (line.size() + 1 + method->name.size() > width) {
            text += "\n" + line;
            line = " ";
        }
        line += " " + std::string(method->name);
    }
    return text + "\n" + line + "\n";
}

} // namespace hemilux
