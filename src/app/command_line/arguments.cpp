#include "app/command_line/arguments.h"

#include "app/command_line/generated/generated_texts.h"
#include "app/command_line/unknown_option.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "app/settings/shell_word.h"
#include "radiosity/answers/asked/text.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

namespace hemilux {

namespace {

/// The parser gives no name to options without a group, so those that help leaves out have this.
constexpr const char* hidden_group = "Hidden";

std::vector<std::string> names_of(const std::vector<const CLI::App*>& subcommands) {
    std::vector<std::string> names;
    for (const CLI::App* const subcommand : subcommands)
        names.push_back(subcommand->get_name());
    return names;
}

std::vector<const CLI::App*> all_subcommands(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App*) { return true; });
}

/// Returns the subcommand that was named, else the program.
const CLI::App& command_of(const CLI::App& program) {
    const std::vector<CLI::App*> parsed = program.get_subcommands();
    return parsed.empty() ? program : *parsed.front();
}

/// Returns what the parser did not understand, with the nearest name that it would.
std::string unknown_argument(const CLI::App& program, const std::string& otherwise) {
    const CLI::App& command = command_of(program);
    const std::vector<std::string> left = command.remaining();
    if (left.empty())
        return otherwise;
    const bool is_option = left.front().starts_with("-");
    if (!is_option && &command != &program)
        return otherwise;
    std::vector<std::string> names;
    if (is_option)
        for (const CLI::Option* const option : command.get_options())
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
    else
        names = names_of(all_subcommands(program));
    const std::string word = left.front().substr(0, left.front().find('='));
    return is_option ? unknown_option(word, names) : unknown_name("subcommand", word, names);
}

/// Returns the option of a message of the parser, which begins with one of its names; or nullptr.
const CLI::Option* option_of(const CLI::App& command, const std::string& message) {
    return command.get_option_no_throw(message.substr(0, message.find(':')));
}

/// Returns what the parser did not take, in this program's words.
std::string refused(const CLI::App& program, const CLI::ParseError& error) {
    const CLI::App& command = command_of(program);
    const std::vector<std::string> subcommands = names_of(all_subcommands(program));
    if (&command == &program && !subcommands.empty() &&
        dynamic_cast<const CLI::RequiredError*>(&error))
        return "expected a subcommand, one of " + list_names(subcommands, subcommands.size());
    std::string message = error.what();
    if (dynamic_cast<const CLI::RequiredError*>(&error))
        return command.get_name() + ": expected " + message.substr(0, message.find(' ')) +
               ", which is missing";
    const CLI::Option* const option = option_of(command, message);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && option) {
        const std::string name = message.substr(0, message.find(':'));
        return option->count() > 1
                   ? name + ": expected once, it is given " + std::to_string(option->count()) +
                         " times"
                   : name + ": expected a value after it: " + option->get_type_name();
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error))
        return message.substr(0, message.find(' ')) + " and " +
               message.substr(message.rfind(' ') + 1) + " contradict each other; give one of them";
    const std::vector<std::string> left = command.remaining();
    if (dynamic_cast<const CLI::ExtrasError*>(&error) && !left.empty())
        return "'" + left.front() + "' was not expected; an option's value follows its name";
    return message;
}

std::vector<std::string> dashed_names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

CommandText described(const CLI::App& command) {
    CommandText text{command.get_name(), command.get_description(), {}, command.get_footer()};
    for (const CLI::Option* const option : command.get_options()) {
        OptionText of_option{dashed_names_of(*option),
                             {},
                             option->get_description(),
                             option->get_group(),
                             option->get_expected_max() > 1};
        if (of_option.group == hidden_group)
            of_option.group.clear();
        if (option->get_items_expected_max() > 0)
            of_option.type = option->get_type_name();
        if (option->get_positional())
            of_option.names.push_back(option->get_name(true));
        for (const CLI::Option* const other : option->get_excludes())
            for (const std::string& name : dashed_names_of(*other))
                of_option.excludes.push_back(name);
        text.options.push_back(std::move(of_option));
    }
    std::stable_partition(text.options.begin(), text.options.end(), [](const OptionText& option) {
        return option.group == often_used_group;
    });
    return text;
}

/// Returns the program, then its subcommands.
std::vector<CommandText> all_described(const CLI::App& program) {
    std::vector<CommandText> texts{described(program)};
    for (const CLI::App* const subcommand : all_subcommands(program))
        texts.push_back(described(*subcommand));
    return texts;
}

/// A formatter of help whose lines begin with what is typed: options that contradict each other are
/// named in the descriptions.
class HelpFormatter : public CLI::Formatter {
  public:
    /// `folded` is a heading under which options are named only; `more` says where the rest is.
    explicit HelpFormatter(std::string folded = {}, std::string more = {})
        : folded_(std::move(folded)), more_(std::move(more)) {}

    std::string make_option_opts(const CLI::Option* option) const override {
        const std::string text = CLI::Formatter::make_option_opts(option);
        return text.substr(0, text.find(" Excludes:"));
    }
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override {
        if (group == hidden_group)
            return "";
        if (group != folded_)
            return CLI::Formatter::make_group(group, is_positional, options);
        std::string line = "\n" + group + " (" + more_ + "):\n ", text;
        constexpr std::size_t width = 80;
        for (const CLI::Option* const option : options) {
            const std::string name = " " + option->get_name();
            if (line.size() - line.rfind('\n') + name.size() > width) {
                text += line + "\n";
                line = " ";
            }
            line += name;
        }
        return text + line + "\n";
    }

  private:
    std::string folded_, more_;
};

void describe_exclusion(CLI::Option& of, const CLI::Option& other) {
    if (other.get_group() != hidden_group)
        of.description(of.get_description() + " (not with " + other.get_name() + ")");
}

} // namespace

std::string help_in_columns(const std::string& help) {
    constexpr std::size_t width = 80, min_column = 20, default_column = 30;
    std::istringstream lines(help);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        std::size_t column = default_column;
        if (!line.starts_with("  -") || line.size() < column || line[column - 1] != ' ') {
            const std::size_t gap = line.substr(0, column).rfind("  ");
            column = gap == std::string::npos ? 0 : line.find_first_not_of(' ', gap);
        }
        while (line.size() > width && column >= min_column && column <= default_column) {
            std::size_t end = line.rfind(' ', width);
            if (end <= column)
                end = line.find(' ', width);
            if (end == std::string::npos)
                break;
            text += line.substr(0, end) + "\n";
            line = std::string(column, ' ') + line.substr(end + 1);
        }
        if (!line.empty() || !text.ends_with("\n\n"))
            text += line + "\n";
    }
    return text;
}

Option Option::required() const {
    option_->required();
    return *this;
}

Option Option::excludes(Option other) const {
    option_->excludes(other.option_);
    describe_exclusion(*option_, *other.option_);
    describe_exclusion(*other.option_, *option_);
    return *this;
}

Option Option::repeatable() const {
    option_->expected(1, CLI::detail::expected_max_vector_size)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    return *this;
}

Option Option::hidden() const {
    option_->group(hidden_group);
    return *this;
}

Option Option::separated_by(char letter) const {
    option_->delimiter(letter);
    return *this;
}

Option Command::added(CLI::Option* option) const {
    if (!heading_.empty())
        option->group(std::string(heading_));
    return Option(*option);
}

Option Command::add_values(const std::string& name, const std::string& type,
                           const std::string& help,
                           std::function<void(const std::vector<std::string>&)> read) const {
    const auto read_all = [read = std::move(read)](const CLI::results_t& texts) {
        read(texts);
        return true;
    };
    return added(app_->add_option(name, read_all, help)->type_name(type));
}

Option Command::add_value(const std::string& name, const std::string& type, const std::string& help,
                          std::function<void(const std::string&)> read) const {
    return add_values(
        name, type, help,
        [read = std::move(read)](const std::vector<std::string>& texts) { read(texts.front()); });
}

Option Command::add_text(const std::string& name, const std::string& type, std::string& target,
                         const std::string& help) const {
    return added(app_->add_option(name, target, help)->type_name(type));
}

Option Command::add_texts(const std::string& name, const std::string& type,
                          std::vector<std::string>& target, const std::string& help) const {
    return added(app_->add_option(name, target, help)->type_name(type));
}

Option Command::add_flag(const std::string& name, bool& target, const std::string& help) const {
    return added(app_->add_flag(name, target, help));
}

Option Command::add_action(const std::string& name, std::function<void()> action,
                           const std::string& help) const {
    return added(app_->add_flag_callback(name, std::move(action), help));
}

Option Command::add_version(const std::string& name, const std::string& version,
                            const std::string& help) const {
    return added(app_->set_version_flag(name, version, help));
}

Option Command::add_answer(const std::string& name, const std::string& type,
                           const std::string& help,
                           std::function<std::string(const std::string&)> answer) const {
    return add_value(name, type, help, [answer = std::move(answer)](const std::string& text) {
        throw CLI::CallForVersion(answer(text), 0);
    });
}

void Command::add_help(const std::string& help) const {
    app_->set_help_flag(); // takes away the one that stands first
    (void)added(app_->add_flag_callback(
        "-h",
        [app = app_] {
            const std::string text =
                app->get_parent() ? short_help(described(*app)) : short_help(all_described(*app));
            throw CLI::CallForVersion(help_in_columns(text), 0);
        },
        "print a short help"));
    (void)added(app_->set_help_flag("--help", help));
}

void Command::in_family(const std::string& heading) const { app_->group(heading); }

void Command::fold_in_help(const std::string& heading, const std::string& more) const {
    app_->formatter(std::make_shared<HelpFormatter>(heading, more));
}

void Command::call_often_used(std::span<const char* const> options) const {
    for (const char* const option : options)
        app_->get_option(option)->group(often_used_group);
}

void Command::end_help_with(const std::string& text) const { app_->footer(text); }

void Command::after_parsing(std::function<void()> action) const {
    app_->parse_complete_callback(std::move(action));
}

bool Command::given(const std::string& option) const { return app_->count(option) > 0; }

std::vector<GivenOption> Command::options_given() const {
    std::vector<GivenOption> given;
    for (const CLI::Option* const option : app_->get_options()) {
        if (option->count() == 0)
            continue;
        GivenOption one{option->get_name(), {}};
        if (option->get_items_expected_max() > 0)
            one.values = option->results();
        if (option->get_delimiter() != '\0')
            one.values = {CLI::detail::join(one.values, std::string(1, option->get_delimiter()))};
        given.push_back(std::move(one));
    }
    return given;
}

std::string Command::text_given(std::span<const std::string_view> except) const {
    std::string text = app_->get_name();
    for (const auto& [name, values] : options_given()) {
        if (std::ranges::find(except, name) != except.end())
            continue;
        const std::string word = name.starts_with("-") ? " " + name : "";
        if (values.empty())
            text += word;
        for (const std::string& value : values)
            text += word + " " + shell_word(value);
    }
    return text;
}

bool Command::parsed() const { return app_->parsed(); }

Arguments::Arguments(const std::string& program, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, program)) {
    app_->formatter(std::make_shared<HelpFormatter>()); // of its subcommands, too
}

Arguments::~Arguments() = default;

Command Arguments::program() const { return Command(*app_); }

Command Arguments::add_command(const std::string& name, const std::string& description) {
    app_->require_subcommand(1);
    return Command(*app_->add_subcommand(name, description));
}

std::vector<std::string> Arguments::commands() const { return names_of(all_subcommands(*app_)); }

std::vector<CommandText> Arguments::described() const { return all_described(*app_); }

std::string Arguments::parse(std::vector<std::string> words) {
    try {
        std::ranges::reverse(words); // as the parser takes them
        app_->parse(std::move(words));
        return {};
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0)
            throw UsageError(unknown_argument(*app_, refused(*app_, error)));
        std::ostringstream text; // --help and --version
        app_->exit(error, text, text);
        return dynamic_cast<const CLI::CallForHelp*>(&error) ? help_in_columns(text.str())
                                                             : text.str();
    }
}

} // namespace hemilux
