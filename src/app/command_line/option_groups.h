#pragma once
// Groups of options that several subcommands share.

#include "app/settings/command_line.h"
#include "app/settings/settings.h"

namespace hemilux {

inline constexpr const char* output_group = "Outputs";

CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& type,
                      std::string& target, const std::string& help);
/// SCENE and what changes it.
void add_scene_options(CLI::App& app, SceneSettings& scene);
/// --memory, of the subcommands that solve.
void add_memory_option(CLI::App& app, SceneSettings& scene);
/// --depth and --threshold: how hemispheres are divided.
void add_division_options(CLI::App& app, SolveOptions& options);
/// --seed and --threads.
void add_random_options(CLI::App& app, SolveOptions& options);
/// --camera and --size.
void add_camera_options(CLI::App& app, ViewSettings& view);
/// The same with --exposure.
void add_view_options(CLI::App& app, ViewSettings& view);
/// -q, -v, --version, --help.
void add_talk_options(CLI::App& app, Talk& talk);

} // namespace hemilux
