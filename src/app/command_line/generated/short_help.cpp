#include "app/command_line/generated/generated_texts.h"

#include <algorithm>
#include <sstream>

namespace hemilux {
namespace {

/// Returns the first of a text with semicolons, without what stands for it by default.
std::string first_thought(const std::string& help) {
    const std::string text = help.substr(0, help.find("; "));
    return text.substr(0, text.find(" ["));
}

/// Returns the lines of a help text that are commands to copy, the first three.
std::string examples_in(const std::string& text) {
    constexpr int most = 3;
    std::istringstream lines(text);
    std::string examples;
    int found = 0;
    for (std::string line; found < most && std::getline(lines, line);)
        if (line.starts_with("  hemilux ")) {
            examples += line + "\n";
            ++found;
        }
    return examples;
}

} // namespace

std::string option_line(const OptionText& option, const std::string& help) {
    constexpr std::size_t column = 30;
    std::string line = " ";
    for (const std::string& name : option.names)
        line += (&name == &option.names.front() ? " " : ",") + name;
    line += option.type.empty() ? "" : " " + option.type;
    if (line.size() + 1 > column)
        line += "\n" + std::string(column, ' ');
    else
        line.resize(column, ' ');
    return line + help + "\n";
}

std::string short_help(const CommandText& command) {
    std::string usage = "hemilux " + command.name + " [OPTIONS]", options;
    for (const OptionText& option : command.options)
        if (!option.names.front().starts_with("-"))
            usage += " " + option.names.front();
        else if (option.group == often_used_group)
            options += option_line(option, first_thought(option.help));
    return command.description + "\nUsage: " + usage + "\n\nExamples:\n" +
           examples_in(command.end) + "\nOptions that are often used:\n" + options + "\nhemilux " +
           command.name + " --help lists all options.\n";
}

std::string short_help(const std::vector<CommandText>& program) {
    std::string text = program.front().description +
                       "\n\n"
                       "  hemilux room.glb                      light a model: room.png\n"
                       "  hemilux room.glb --error 1% -o a.png  with an error of at most 1 %\n"
                       "  hemilux bake room.glb -o lit.glb      put the light into the file\n"
                       "  hemilux solve room.glb -o light.csv   light and error of each patch\n"
                       "  hemilux info room.glb                 what was read, what is doubtful\n"
                       "\nModels are .obj, .gltf, .glb, .stl and .vs3 files. Commands:";
    std::size_t column = 0;
    constexpr std::size_t width = 72;
    for (std::size_t k = 1; k < program.size(); ++k) {
        column = k == 1 || column + program[k].name.size() > width ? 0 : column;
        text += (column == 0 ? "\n  " : " ") + program[k].name;
        column += program[k].name.size() + 1;
    }
    return text + "\n\nhemilux COMMAND -h says more, hemilux --help what they do.\n";
}

} // namespace hemilux
