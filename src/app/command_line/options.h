#pragma once
// The command line: which options there are, what they accept, and the text of --help.

#include "app/command_line/arguments.h"
#include "app/settings/settings.h"

namespace hemilux {

struct DimSettings;        // dim_settings.h
struct ViewFactorSettings; // view_factor_settings.h

/// Each of these adds a subcommand that fills the settings while the arguments are parsed.
Command add_solve_command(Arguments& program, SolveSettings& settings);
Command add_bake_command(Arguments& program, SolveSettings& settings);
Command add_compare_command(Arguments& program, CompareSettings& settings);
Command add_density_command(Arguments& program, DensitySettings& settings);
Command add_formfactors_command(Arguments& program, FormFactorSettings& settings);
Command add_viewfactors_command(Arguments& program, ViewFactorSettings& settings);
Command add_exchange_command(Arguments& program, ViewFactorSettings& settings);
Command add_dim_command(Arguments& program, DimSettings& settings);
Command add_info_command(Arguments& program, InfoSettings& settings);

} // namespace hemilux
