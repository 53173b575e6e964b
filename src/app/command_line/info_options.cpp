// The options of `hemilux info`.

#include "app/command_line/option_groups.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"

#include <array>
#include <string>

namespace hemilux {

namespace {

constexpr const char* info_examples = R"(Examples:
  hemilux info room.obj
  hemilux info room.obj --max-edge 0.1
  hemilux info room.obj --json
)";

} // namespace

Command add_info_command(Arguments& program, InfoSettings& settings) {
    const Command command = program.add_command(
        "info", "what was read from a scene, what is doubtful in it, what it does not need");
    add_scene_options(command, settings.scene);
    add_memory_option(command.under(scene_group), settings.scene);
    command.under(output_group)
        .add_flag("--json", settings.json, "one JSON object instead of lines of text");
    add_verbosity_options(command, settings.verbosity);
    command.call_often_used(std::to_array({"--json", "--sides", "--max-edge"}));
    command.end_help_with(std::string(info_examples) + exit_codes);
    return command;
}

} // namespace hemilux
