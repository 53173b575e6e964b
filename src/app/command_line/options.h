#pragma once
// The command line: which options there are, what they accept, and the text of --help.

#include "app/settings/command_line.h"
#include "app/settings/settings.h"

namespace hemilux {

/// Each adds a subcommand that fills the settings while CLI11 parses.
CLI::App* add_solve_command(CLI::App& program, SolveSettings& settings);
CLI::App* add_compare_command(CLI::App& program, CompareSettings& settings);
CLI::App* add_info_command(CLI::App& program, InfoSettings& settings);

} // namespace hemilux
