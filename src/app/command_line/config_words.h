#pragma once
// --config FILE: options of a file take part as if they stood on the command line.

#include "app/command_line/arguments.h"
#include "app/command_line/config_file.h"

#include <string>
#include <vector>

namespace hemilux {

/// The words of a command line, with the options of its --config file added. Options that the words
/// give or contradict are not added.
class ConfigWords {
  public:
    /// Adds the options; `program` is Arguments::described(). Throws InputError for a file that
    /// cannot be read, and with its line for what is no option of the subcommand.
    ConfigWords(std::vector<std::string> words, const std::vector<CommandText>& program);

    [[nodiscard]] const std::vector<std::string>& words() const { return words_; }
    /// Throws InputError with the line of the file if what was refused is a value from there.
    void explain(const std::string& refused) const;

  private:
    std::string path_; ///< empty: no --config
    std::vector<std::string> words_;
    std::vector<ConfigEntry> added_;
};

} // namespace hemilux
