#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/command_line/options.h"
#include "app/settings/names.h"
#include "radiosity/engine/shooting/additions.h"
#include "radiosity/engine/solving/own_options.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hemilux {

namespace {

constexpr const char* density_examples = R"(Examples:
  hemilux density room.obj -o densities.png
  hemilux density room.obj --patch 17 --rays 1000 -o hemisphere.svg
  hemilux density room.obj --method hemisphere-1997 --estimated-steps 0 -o parts.svg
  hemilux density room.obj --method hemisphere-1997 --plane -o plane.svg
)";

/// Adds --guide, for the guides by which the hemispheres of `hemisphere` are divided; nothing where
/// there is none.
void add_dividing_guide(Command command, SolveOptions& options) {
    std::vector<std::string> names{"density"};
    for (const Guide* const guide : additions().guides)
        if (guide->densities)
            names.emplace_back(guide->name);
    if (names.size() == 1)
        return;
    command.add_value(
        "--guide", joined(names, "|"), "what divides hemisphere's [density]",
        [names, &options](const std::string& text) {
            if (std::ranges::find(names, text) == names.end())
                throw UsageError("--guide: " + unknown_name("choice", text, names));
            const auto found = std::ranges::find(additions().guides, text, &Guide::name);
            const bool is_added = found != additions().guides.end();
            set_own_options(options, GuideChoice{.guide = is_added ? *found : nullptr});
        });
}

/// Adds --method, for the methods whose hemispheres can be drawn.
void add_dividing_method(Command command, const Method*& method) {
    command.add_value("--method", "hemisphere|hemisphere-1997", "whose hemispheres [hemisphere]",
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
                      });
}

} // namespace

Command add_density_command(Arguments& program, DensitySettings& settings) {
    const Method* const forerunner = &method_of(Role::forerunner);
    const Command command = program.add_command(
        "density", "draw the divided hemisphere of a patch, or the densities of a scene");
    const Command method = command.under(method_group), outputs = command.under(output_group);
    add_scene_options(command, settings.scene);
    add_memory_option(command.under(scene_group), settings.scene);
    add_dividing_method(method, settings.method);
    add_division_options(method, settings.options);
    add_dividing_guide(method, settings.options);
    add_own_options(command.under(own_group), {&forerunner, 1}, settings.options);
    add_random_options(method, settings.options);
    add_path(outputs, "-o,--output", "FILE",
             "a patch's hemisphere .svg, mean densities of all patches .png; repeatable",
             ".svg or .png", settings.outputs)
        .required();
    add_whole(outputs, "--patch", settings.patch, 0, std::numeric_limits<std::uint32_t>::max(),
              "whose hemisphere; from 0 [the one with the largest spread]");
    add_whole(outputs, "--part", settings.part, 0, 63,
              "of the patch, whose hemisphere is shown from above [0]");
    add_whole(outputs, "--rays", settings.rays, 0, 100'000, "energy rays to show in it [0]");
    outputs.add_flag("--plane", settings.plane,
                     "draw the subdivision in a plane across the patch, as the paper's figure 1");
    add_camera_options(outputs, settings.view);
    add_verbosity_options(command, settings.verbosity);
    command.call_often_used(
        std::to_array({"--output", "--method", "--patch", "--depth", "--threshold", "--plane"}));
    command.end_help_with(density_examples);
    return command;
}

} // namespace hemilux
