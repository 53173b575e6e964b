#pragma once
// Texts for other programs, made from the declarations that --help is made from.

#include "app/command_line/arguments.h"

#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// This is the heading of the options that the short help has.
inline constexpr const char* often_used_group = "Often used";

/// Returns an option with this help, as a line of help_in_columns().
[[nodiscard]] std::string option_line(const OptionText& option, const std::string& help);
/// Returns the short help of a subcommand: its first three examples and the options that are often
/// used.
[[nodiscard]] std::string short_help(const CommandText& command);
/// Returns the short help of the program.
[[nodiscard]] std::string short_help(const std::vector<CommandText>& program);

/// Returns a manual page (man macros of roff), with `version` in its foot line.
[[nodiscard]] std::string manual_page(const std::vector<CommandText>& program,
                                      const std::string& version);

/// Returns completions of subcommands, options and values that are choices, for a shell: bash, zsh
/// or fish. `methods` are the names that stand for METHOD. The text is empty for other shells.
[[nodiscard]] std::string completions(std::string_view shell,
                                      const std::vector<CommandText>& program,
                                      const std::vector<std::string>& methods);

} // namespace hemilux
