#pragma once
// The arguments of a program: options with their help, subcommands, and messages about mistakes.
// CLI11 does the work. It takes long to compile, so arguments.cpp alone includes it.

#include "io/results/statistics.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace hemilux {

/// An option that has been added. Copies mean the same option.
class Option {
  public:
    explicit Option(CLI::Option& option) : option_(&option) {}
    Option required() const;
    /// Declares that at most one of the two may be given.
    Option excludes(Option other) const;
    /// Declares that it may be given several times, with one value each time.
    Option repeatable() const;
    /// Leaves the option out of all help; it works as before. Called before excludes().
    Option hidden() const;
    /// Declares that a value may be several, with this letter between them.
    Option separated_by(char letter) const;

  private:
    CLI::Option* option_;
};

/// The declaration of an option.
struct OptionText {
    std::vector<std::string> names; ///< names with their dashes; one without dashes: a positional
    std::string type, help;         ///< type: empty where it takes no value
    std::string group;              ///< heading of --help; empty: help leaves it out
    bool repeatable = false;
    std::vector<std::string> excludes = {}; ///< names of options that it contradicts
};

/// The declaration of a subcommand, or of the program itself.
struct CommandText {
    std::string name, description;
    std::vector<OptionText> options;
    std::string end; ///< text after its help
};

/// A subcommand, or a program without any. Copies mean the same one; all of it, and what options
/// write to, outlives the parsing. `type` is what --help says of an option's value.
class Command {
  public:
    explicit Command(CLI::App& app, std::string_view heading = {})
        : app_(&app), heading_(heading) {}
    /// Returns the same command, whose options that are added stand under a heading of --help.
    [[nodiscard]] Command under(std::string_view heading) const { return Command(*app_, heading); }
    /// Adds an option. `read` gets all values that were given, and throws UsageError for those that
    /// it refuses.
    Option add_values(const std::string& name, const std::string& type, const std::string& help,
                      std::function<void(const std::vector<std::string>&)> read) const;
    /// Adds an option in the same way, with one value.
    Option add_value(const std::string& name, const std::string& type, const std::string& help,
                     std::function<void(const std::string&)> read) const;
    Option add_text(const std::string& name, const std::string& type, std::string& target,
                    const std::string& help) const;
    Option add_texts(const std::string& name, const std::string& type,
                     std::vector<std::string>& target, const std::string& help) const;
    Option add_flag(const std::string& name, bool& target, const std::string& help) const;
    /// Adds a flag that does something where it is given.
    Option add_action(const std::string& name, std::function<void()> action,
                      const std::string& help) const;
    Option add_version(const std::string& name, const std::string& version,
                       const std::string& help) const;
    /// Adds an option of one value whose answer is a text, as that of --help is.
    Option add_answer(const std::string& name, const std::string& type, const std::string& help,
                      std::function<std::string(const std::string&)> answer) const;
    /// Adds --help, which stands where this is called, not first, and -h, the short help.
    void add_help(const std::string& help) const;
    /// Puts the subcommand under a heading of its own among the others.
    void in_family(const std::string& heading) const;
    /// Lets --help name the options under this heading without saying what they do; `more` says
    /// where that is said.
    void fold_in_help(const std::string& heading, const std::string& more) const;
    /// Puts these options under a heading of their own, which is the first one of --help where one
    /// of them was added first.
    void call_often_used(std::span<const char* const> options) const;
    /// Sets the text that --help ends with.
    void end_help_with(const std::string& text) const;
    void after_parsing(std::function<void()> action) const;

    /// Returns whether the option was given.
    [[nodiscard]] bool given(const std::string& option) const;
    /// Returns what was given, in the order of --help.
    [[nodiscard]] std::vector<GivenOption> options_given() const;
    /// Returns the same, as a shell takes it; without the options of these names.
    [[nodiscard]] std::string text_given(std::span<const std::string_view> except) const;
    /// Returns whether the subcommand was named.
    [[nodiscard]] bool parsed() const;

  private:
    [[nodiscard]] Option added(CLI::Option* option) const;

    CLI::App* app_;
    std::string_view heading_; ///< empty: that of the parser
};

/// Breaks the descriptions of options and methods, which stand in a column of their own, before
/// column 80. All other lines stay, as commands are copied from them; of empty ones, one stays.
[[nodiscard]] std::string help_in_columns(const std::string& help);

class Arguments {
  public:
    Arguments(const std::string& program, const std::string& description);
    ~Arguments();
    Arguments(const Arguments&) = delete;
    Arguments& operator=(const Arguments&) = delete;

    /// Returns the program itself, to which options may be added.
    [[nodiscard]] Command program() const;
    /// Adds a subcommand. One of the subcommands has to be named.
    Command add_command(const std::string& name, const std::string& description);
    [[nodiscard]] std::vector<std::string> commands() const;
    /// Returns the program, then its subcommands.
    [[nodiscard]] std::vector<CommandText> described() const;

    /// Fills what the options write to. Returns the text that --help or --version asked for; empty
    /// where the program is to do its work. Throws UsageError, which for an unknown name tells the
    /// nearest known one.
    [[nodiscard]] std::string parse(std::vector<std::string> words);

  private:
    std::unique_ptr<CLI::App> app_;
};

} // namespace hemilux
