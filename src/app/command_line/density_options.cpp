#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/commands/density.h"
#include "app/settings/extension.h"
#include "app/settings/names.h"

#include <limits>

namespace hemilux {

namespace {

constexpr const char* examples = R"(Examples:
  hemilux density room.obj -o densities.png
  hemilux density room.obj --patch 17 --rays 1000 -o hemisphere.svg
  hemilux density room.obj --method hemisphere-1997 --estimated-steps 0 -o parts.svg
  hemilux density room.obj --method hemisphere-1997 --plane -o plane.svg
)";

std::optional<std::string> drawing_path(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".svg" || extension == ".png" ? std::optional(path) : std::nullopt;
}

/// Of the methods whose hemispheres can be drawn.
void add_dividing_method(Command command, const Method*& method) {
    command
        .add_value("--method", "NAME",
                   "whose hemispheres: hemisphere or hemisphere-1997 [hemisphere]",
                   [&method](const std::string& name) {
                       std::vector<std::string> names;
                       for (const Role role : {Role::paper, Role::forerunner}) {
                           const Method& one = method_of(role);
                           names.emplace_back(one.name);
                           if (one.name == name) {
                               method = &one;
                               return;
                           }
                       }
                       throw UsageError("--method: " + unknown_name("method", name, names));
                   })
        .group("Method");
}

} // namespace

Command add_density_command(Arguments& program, DensitySettings& settings) {
    const Method* const forerunner = &method_of(Role::forerunner);
    const Command command = program.add_command(
        "density", "draw the divided hemisphere of a patch, or the densities of a scene");
    add_scene_options(command, settings.scene);
    add_dividing_method(command, settings.method);
    add_division_options(command, settings.options);
    add_guide_option(command, settings.options.guide, 2,
                     "what divides hemisphere's: density or pyramid [density]");
    add_own_numbers(command, {&forerunner, 1}, settings.options);
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
    add_whole<std::uint32_t>(command, "--part", settings.part, 0, 63,
                             "of the patch, whose hemisphere is shown from above [0]")
        .group(output_group);
    add_whole<std::uint32_t>(command, "--rays", settings.rays, 0, 100'000,
                             "energy rays to show in it [0]")
        .group(output_group);
    command
        .add_flag("--plane", settings.plane,
                  "draw the subdivision in a plane across the patch, as the paper's figure 1")
        .group(output_group);
    add_camera_options(command, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.end_help_with(examples);
    return command;
}

} // namespace hemilux
