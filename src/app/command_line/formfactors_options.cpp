#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"

#include <array>
#include <bit>

namespace hemilux {

namespace {

constexpr const char* formfactors_examples = R"(Examples:
  hemilux formfactors room.obj -o factors.csv
  hemilux formfactors room.obj --factors exact -o factors.npy -o factors.csv
  hemilux formfactors room.obj --factors hemicube:256 -o factors.csv
)";

std::optional<std::uint32_t> power_of_two(const std::string& text) {
    constexpr std::uint64_t most = 1u << 20;
    const std::optional<std::uint64_t> value = parse_whole(text);
    return value && std::has_single_bit(*value) && *value <= most
               ? std::optional(static_cast<std::uint32_t>(*value))
               : std::nullopt;
}

} // namespace

Command add_formfactors_command(Arguments& program, FormFactorSettings& settings) {
    const Command command = program.add_command(
        "formfactors", "write form factors of `matrix`; viewfactors --by patch: with errors");
    const Command method = command.under(method_group);
    add_scene_options(command, settings.scene);
    add_memory_option(command.under(scene_group), settings.scene);
    add_parsed(method, "--rays", "N", "rays per patch, a power of two [4096]",
               "a power of two from 1 to 1048576", power_of_two, settings.rays);
    const Method* const same = &method_of(Role::reference);
    add_own_options(method, {&same, 1}, settings.options);
    add_random_options(method, settings.options);
    add_path(command.under(output_group), "-o,--output", "FILE",
             "i,j,F of the factors above 0 .csv, dense NumPy array .npy; repeatable",
             ".csv or .npy", settings.outputs)
        .required();
    add_verbosity_options(command, settings.verbosity);
    command.in_family(factor_family);
    command.call_often_used(std::to_array({"--output", "--rays", "--factors", "--threads"}));
    command.end_help_with(formfactors_examples);
    return command;
}

} // namespace hemilux
