#include "app/command_line/option_groups.h"
#include "app/command_line/option_kinds.h"
#include "app/commands/density.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"

#include <CLI/CLI.hpp>
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

CLI::App* add_density_command(CLI::App& program, DensitySettings& settings) {
    CLI::App* const app = program.add_subcommand(
        "density", "draw the divided hemisphere of a patch, or the densities of a scene");
    add_scene_options(*app, settings.scene);
    add_division_options(*app, settings.options);
    add_random_options(*app, settings.options);
    repeatable(
        add_parsed(*app, "-o,--output", "FILE",
                   "a patch's hemisphere .svg, mean densities of all patches .png; repeatable",
                   "a file name that ends with .svg or .png", drawing_path,
                   [&settings](const std::string& path) { settings.outputs.push_back(path); }))
        ->required()
        ->group(output_group);
    add_whole<std::uint32_t>(*app, "--patch", settings.patch, 0,
                             std::numeric_limits<std::uint32_t>::max(),
                             "whose hemisphere; from 0 [the one with the largest spread]")
        ->group(output_group);
    add_whole<std::uint32_t>(*app, "--rays", settings.rays, 0, 100'000,
                             "energy rays to show in it [0]")
        ->group(output_group);
    add_camera_options(*app, settings.view);
    add_talk_options(*app, settings.talk);
    app->footer(examples);
    return app;
}

} // namespace hemilux
