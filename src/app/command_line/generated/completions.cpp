#include "app/command_line/generated/generated_texts.h"

#include "app/settings/names.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace hemilux {
namespace {

/// Returns the words that a value of this type may be; those of its choices that stand for no other
/// text.
std::vector<std::string> choices_of(const std::string& type,
                                    const std::vector<std::string>& methods) {
    if (type.starts_with("METHOD"))
        return methods;
    std::vector<std::string> words;
    if (type.find('|') == std::string::npos)
        return words;
    for (const std::string_view word : parts_of(type, '|'))
        if (std::ranges::none_of(
                word, [](unsigned char c) { return std::isupper(c) != 0 || c == '[' || c == '%'; }))
            words.emplace_back(word);
    return words;
}

bool is_file(const std::string& type) {
    return type.starts_with("FILE") || type.starts_with("DIR");
}

bool is_positional(const OptionText& option) { return !option.names.front().starts_with("-"); }

/// Returns the first thought of a help text, without what a shell would take for more than a
/// letter.
std::string summary(const std::string& help) {
    std::string text = help;
    for (const char* const end : {"; ", ": ", ". ", " [", ", "})
        text = text.substr(0, text.find(end));
    std::erase_if(text, [](char c) {
        return std::string_view("'`\"\\[]$").find(c) != std::string_view::npos;
    });
    return text;
}

std::vector<std::string> option_names(const CommandText& command) {
    std::vector<std::string> names;
    for (const OptionText& option : command.options)
        if (!is_positional(option))
            names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::vector<std::string> subcommands(const std::vector<CommandText>& program) {
    std::vector<std::string> names;
    for (std::size_t k = 1; k < program.size(); ++k)
        names.push_back(program[k].name);
    return names;
}

/// Returns the completions for bash, which offers files where no word is offered.
std::string bash(const std::vector<CommandText>& program, const std::vector<std::string>& methods) {
    std::string text =
        "# bash completion for hemilux\n"
        "_hemilux() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
        "    local command=${COMP_WORDS[1]} words=\n"
        "    [ \"$COMP_CWORD\" -gt 1 ] || command=\n"
        "    case $command/$before in\n";
    for (const CommandText& command : program)
        for (const OptionText& option : command.options) {
            const std::vector<std::string> choices = choices_of(option.type, methods);
            if (choices.empty())
                continue;
            const std::string name = &command == &program.front() ? "" : command.name;
            text += "    " + name + "/" + joined(option.names, " | " + name + "/") + ") words='" +
                    joined(choices, " ") + "' ;;\n";
        }
    text += "    *) case $word/$command in\n";
    for (std::size_t k = 1; k < program.size(); ++k)
        text += "        -*/" + program[k].name + ") words='" +
                joined(option_names(program[k]), " ") + "' ;;\n";
    text += "        */) words='" + joined(subcommands(program), " ") + " help " +
            joined(option_names(program.front()), " ") + "' ;;\n" + "        */help) words='" +
            joined(subcommands(program), " ") + "' ;;\n" +
            "        esac ;;\n"
            "    esac\n"
            "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
            "}\n"
            "complete -o default -F _hemilux hemilux\n";
    return text;
}

/// Returns what _arguments takes of an option, for each of its names.
std::string zsh_option(const OptionText& option, const std::vector<std::string>& methods) {
    std::string value;
    if (!option.type.empty()) {
        const std::vector<std::string> choices = choices_of(option.type, methods);
        value = ":value:" + (is_file(option.type) ? "_files"
                             : choices.empty()    ? " "
                                                  : "(" + joined(choices, " ") + ")");
    }
    if (is_positional(option))
        return "        '1:" + option.names.front() + ":_files'";
    std::string text;
    for (const std::string& name : option.names)
        text += (text.empty() ? "" : " \\\n") + std::string("        '") +
                (option.repeatable ? "*" : "") + name + "[" + summary(option.help) + "]" + value +
                "'";
    return text;
}

std::string zsh(const std::vector<CommandText>& program, const std::vector<std::string>& methods) {
    std::string text = "#compdef hemilux\n"
                       "_hemilux() {\n"
                       "    if (( CURRENT == 2 )); then\n"
                       "        local -a commands=(\n";
    for (std::size_t k = 1; k < program.size(); ++k)
        text += "            '" + program[k].name + ":" + summary(program[k].description) + "'\n";
    text += "            'help:what can be asked for'\n        )\n"
            "        _describe subcommand commands\n"
            "        _files\n"
            "        return\n"
            "    fi\n"
            "    shift words\n"
            "    (( CURRENT-- ))\n"
            "    case $words[1] in\n";
    for (std::size_t k = 1; k < program.size(); ++k) {
        text += "    " + program[k].name + ") _arguments";
        for (const OptionText& option : program[k].options)
            text += " \\\n" + zsh_option(option, methods);
        text += " ;;\n";
    }
    return text + "    help) _values subcommand " + joined(subcommands(program), " ") +
           " ;;\n"
           "    esac\n"
           "}\n"
           "if [ \"$funcstack[1]\" = _hemilux ]; then _hemilux \"$@\"; else compdef _hemilux "
           "hemilux; "
           "fi\n";
}

std::string fish(const std::vector<CommandText>& program, const std::vector<std::string>& methods) {
    std::string text;
    for (const CommandText& command : program) {
        const bool is_program = &command == &program.front();
        const std::string where =
            std::string("complete -c hemilux -n '") +
            (is_program ? "__fish_use_subcommand" : "__fish_seen_subcommand_from " + command.name) +
            "'";
        if (!is_program)
            text += "complete -c hemilux -n __fish_use_subcommand -f -a " + command.name + " -d '" +
                    summary(command.description) + "'\n";
        for (const OptionText& option : command.options) {
            if (is_positional(option))
                continue;
            text += where;
            for (const std::string& name : option.names)
                text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
            if (!option.type.empty())
                text += is_file(option.type)
                            ? " -r -F"
                            : " -x -a '" + joined(choices_of(option.type, methods), " ") + "'";
            text += " -d '" + summary(option.help) + "'\n";
        }
    }
    return text;
}

} // namespace

std::string completions(std::string_view shell, const std::vector<CommandText>& described,
                        const std::vector<std::string>& methods) {
    std::vector<CommandText> program = described;
    for (CommandText& command : program)
        std::erase_if(command.options,
                      [](const OptionText& option) { return option.group.empty(); });
    return shell == "bash"   ? bash(program, methods)
           : shell == "zsh"  ? zsh(program, methods)
           : shell == "fish" ? fish(program, methods)
                             : std::string();
}

} // namespace hemilux
