#pragma once
// Groups of options that several subcommands share.

#include "app/command_line/arguments.h"
#include "app/settings/settings.h"

#include <cstddef>
#include <span>
#include <string>

namespace hemilux {

// These are headings of --help that several subcommands have.
inline constexpr const char* scene_group = "Scene";
inline constexpr const char* method_group = "Method";
inline constexpr const char* output_group = "Outputs";
inline constexpr const char* own_group = "Of one method"; ///< a few count too
/// The heading of subcommands that find factors between surfaces.
inline constexpr const char* factor_family = "Factors between surfaces";

/// Adds SCENE and, under a heading of their own, the options that change it; returns --max-edge.
Option add_scene_options(Command command, SceneSettings& scene);
/// Adds SCENE and the options that change its shapes alone, for subcommands to which light means
/// nothing.
void add_geometry_options(Command command, SceneSettings& scene);
/// Adds --memory.
void add_memory_option(Command command, SceneSettings& scene);
/// Adds --depth and --threshold, which say how hemispheres are divided.
void add_division_options(Command command, SolveOptions& options);
/// Adds what these methods declare (Method::options), each name once.
void add_own_options(Command command, std::span<const Method* const> methods,
                     SolveOptions& options);
/// Returns whether an option says what another says too, in fewer letters; no help has it.
[[nodiscard]] bool is_alias(const MethodOption& option);
/// Adds --seed and --threads.
void add_random_options(Command command, SolveOptions& options);
/// Adds --checkpoint, --every and --resume.
void add_checkpoint_options(Command command, CheckpointSettings& checkpoint);
/// Adds --camera and --size.
void add_camera_options(Command command, ViewSettings& view);
/// Adds --exposure and --tone.
void add_exposure_options(Command command, ViewSettings& view);
/// Adds all of these.
void add_view_options(Command command, ViewSettings& view);
/// Adds --report, a page with these contents.
void add_report_option(Command command, std::string& report, const char* contents);
/// Adds -q, -v, --version, -h and --help under a heading of their own.
void add_verbosity_options(Command command, Verbosity& verbosity);

} // namespace hemilux
