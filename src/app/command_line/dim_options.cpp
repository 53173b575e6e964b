// The options of `hemilux dim`.

#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/settings/dim_settings.h"
#include "app/settings/exit_code.h"

#include <array>
#include <string>

namespace hemilux {

namespace {

constexpr const char* dim_examples = R"(Examples:
  hemilux solve room.obj --layers lamp -o room.exr -o room.csv
  hemilux dim room.exr --power 'desk=0.2' --power 'ceiling*=1,.8,.6' -o evening.png
  hemilux dim room.csv --power '*=0' --power desk=1 -o desk.csv
  hemilux solve room.obj --layers lamp --points desks.txt --points-output desks.csv
  hemilux dim desks.csv --wish wishes.csv -o wished.csv
)";

} // namespace

Command add_dim_command(Arguments& program, DimSettings& settings) {
    const Command command = program.add_command(
        "dim", "give the lamps of a run with --layers other powers, without a ray");
    command
        .add_text("INPUT", "FILE", settings.input,
                  "a picture .exr or a table .csv of solve --layers")
        .required();
    const Command outputs = command.under(output_group);
    add_parsed(
        command, "--power", "LAMP=X|R,G,B",
        "how many times as bright a lamp is as it was solved for; * in its name stands for any "
        "letters; the last that names a lamp counts; repeatable",
        "LAMP=FACTOR or LAMP=R,G,B with factors of 0 or more",
        [](const std::string& text) { return parse_override(text, non_negative); },
        settings.powers);
    command.add_text("--wish", "FILE.csv", settings.wishes,
                     "find the powers that bring points of a table of --points-output nearest to "
                     "wished irradiances: rows point,wish or point,r,g,b; prints them");
    add_parsed(
        outputs, "-o,--output", "FILE",
        "the light by these powers: .csv of a table; .exr, .hdr or .png of a picture; repeatable",
        "a file name that ends with .csv, .exr, .hdr or .png", parse_output, settings.outputs);
    add_exposure_options(outputs, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.call_often_used(std::to_array({"--output", "--power", "--wish"}));
    command.end_help_with(std::string(dim_examples) + exit_codes);
    return command;
}

} // namespace hemilux
