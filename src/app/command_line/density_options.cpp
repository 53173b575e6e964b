#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/commands/density.h"
#include "app/settings/extension.h"

#include <limits>

namespace hemilux {

namespace {

constexpr const char* examples = R"(Examples:
  hemilux density room.obj -o densities.png
  hemilux density room.obj --patch 17 --rays 1000 -o hemisphere.svg
)";

std::optional<std::string> drawing_path(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".svg" || extension == ".png" ? std::optional(path) : std::nullopt;
}

} // namespace

Command add_density_command(Arguments& program, DensitySettings& settings) {
    const Command command = program.add_command(
        "density", "draw the divided hemisphere of a patch, or the densities of a scene");
    add_scene_options(command, settings.scene);
    add_division_options(command, settings.options);
    add_random_options(command, settings.options);
    add_parsed(command, "-o,--output", "FILE",
               "a patch's hemisphere .svg, mean densities of all patches .png; repeatable",
               "a file name that ends with .svg or .png", drawing_path,
               [&settings](const std::string& path) { settings.outputs.push_back(path); })
        .repeatable()
        .required()
        .group(output_group);
    add_whole<std::uint32_t>(command, "--patch", settings.patch, 0,
                             std::numeric_limits<std::uint32_t>::max(),
                             "whose hemisphere; from 0 [the one with the largest spread]")
        .group(output_group);
    add_whole<std::uint32_t>(command, "--rays", settings.rays, 0, 100'000,
                             "energy rays to show in it [0]")
        .group(output_group);
    add_camera_options(command, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.end_help_with(examples);
    return command;
}

} // namespace hemilux
