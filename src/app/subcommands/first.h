#pragma once
// The subcommands that a picture is made with, which the first program has and no others.

#include "app/command_line/options.h"
#include "app/commands/commands.h"
#include "app/subcommands/subcommand.h"

namespace hemilux {

inline int bake(const SolveSettings& settings) {
    return settings.file_bake.occlusion ? bake_occlusion(settings) : solve(settings);
}

inline constexpr int (*solve_scene)(const SolveSettings&) = solve; // not the library's (run.h)

inline constexpr AddSubcommand solve_subcommand =
    subcommand<SolveSettings, add_solve_command, solve_scene>;
inline constexpr AddSubcommand model_subcommand =
    subcommand<SolveSettings, add_solve_command, light_model>;
inline constexpr AddSubcommand bake_subcommand = subcommand<SolveSettings, add_bake_command, bake>;
inline constexpr AddSubcommand info_subcommand = subcommand<InfoSettings, add_info_command, info>;

} // namespace hemilux
