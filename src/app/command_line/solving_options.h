#pragma once
// Groups of options that `solve` and `compare` share, and the ends of their --help.

#include "app/command_line/arguments.h"
#include "app/settings/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace hemilux {

inline constexpr const char* comparison_group = "Comparison";

/// Adds --rays and others that say how to solve, but for the method itself; what only some methods
/// take is added to `own`.
void add_method_options(Command command, Command own, SolveOptions& options);
/// Adds --steps, --time, --error and --max-rays.
void add_stop_options(Command command, StopRule& stop);
/// Adds --layers.
void add_layers_option(Command command, std::optional<LayersBy>& layers);
/// Adds --detail.
void add_detail_option(Command command, std::vector<std::string>& detail);

/// Returns the names of the methods.
[[nodiscard]] std::string methods_text();
/// Returns the help of one method where the words ask for that, as `solve --help METHOD`: what it
/// is, and the options that it alone or few have. `program` is Arguments::described(). Throws
/// UsageError for another name.
[[nodiscard]] std::optional<std::string> method_help(const std::vector<std::string>& words,
                                                     const std::vector<CommandText>& program);
/// Lets --help name these options only; `--help METHOD` says what they do.
void fold_own_options(Command command);
/// This text says what the program's exit codes mean.
inline constexpr const char* exit_codes = R"(
Exit codes: 0 done, 1 wrong usage, 2 bad input, 3 output or system failure,
130 interrupted by Ctrl-C, 143 by SIGTERM, 129 by a terminal that was closed
(what was computed is written).)";

} // namespace hemilux
