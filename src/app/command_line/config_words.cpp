#include "app/command_line/config_words.h"

#include "app/command_line/unknown_option.h"
#include "app/settings/names.h"
#include "io/files/error.h"

#include <algorithm>
#include <utility>

namespace hemilux {
namespace {

/// Returns FILE of `--config FILE` or `--config=FILE`; empty where there is none.
std::string config_path(const std::vector<std::string>& words) {
    const std::string name = "--config";
    for (std::size_t k = 0; k < words.size(); ++k)
        if (words[k] == name && k + 1 < words.size())
            return words[k + 1];
        else if (words[k].starts_with(name + "="))
            return words[k].substr(name.size() + 1);
    return {};
}

/// Returns whether the word is an option of one of these names, with its value or without.
bool is_option(const std::string& word, const std::vector<std::string>& names) {
    return std::ranges::any_of(names, [&word](const std::string& name) {
        const bool is_long = name.starts_with("--");
        return word == name || word.starts_with(is_long ? name + "=" : name);
    });
}

/// Returns the words that an entry stands for.
std::vector<std::string> words_of(const std::string& path, const ConfigEntry& entry,
                                  const OptionText& option) {
    const std::string name = "--" + entry.key;
    if (option.type.empty() != entry.truth)
        throw InputError(path, entry.line,
                         "'" + entry.key + "': expected " +
                             (option.type.empty() ? "true or false" : option.type));
    if (entry.truth)
        return entry.values.front() == "true" ? std::vector{name} : std::vector<std::string>();
    if (!option.repeatable || !entry.list)
        return {name + "=" + joined(entry.values, ",")};
    std::vector<std::string> words;
    for (const std::string& value : entry.values)
        words.push_back(name + "=" + value);
    return words;
}

} // namespace

ConfigWords::ConfigWords(std::vector<std::string> words, const std::vector<CommandText>& program)
    : words_(std::move(words)) {
    const auto named = [this](const CommandText& command) {
        return !words_.empty() && words_.front() == command.name;
    };
    const auto command = std::ranges::find_if(program, named);
    if (command == program.end())
        return; // is refused by the parser
    const std::vector<std::string> given = words_;
    path_ = config_path(given);
    if (path_.empty())
        return;
    std::vector<std::string> names, tables;
    for (const OptionText& option : command->options)
        if (option.names.back().starts_with("--") && option.names.back() != "--config")
            names.push_back(option.names.back().substr(2));
    for (const CommandText& other : program)
        tables.push_back(other.name);
    for (const ConfigEntry& entry : read_config(path_)) {
        if (!entry.table.empty() && std::ranges::find(tables, entry.table) == tables.end())
            throw InputError(path_, entry.line, unknown_name("subcommand", entry.table, tables));
        if (!entry.table.empty() && entry.table != command->name)
            continue;
        if (std::ranges::find(names, entry.key) == names.end())
            throw InputError(path_, entry.line, unknown_option(entry.key, names));
        const auto option = std::ranges::find_if(command->options, [&entry](const OptionText& one) {
            return one.names.back() == "--" + entry.key;
        });
        if (std::ranges::any_of(given, [&option](const std::string& word) {
                return is_option(word, option->names) || is_option(word, option->excludes);
            }))
            continue;
        const std::vector<std::string> more = words_of(path_, entry, *option);
        words_.insert(words_.end(), more.begin(), more.end());
        added_.push_back(entry);
    }
}

void ConfigWords::explain(const std::string& refused) const {
    for (const ConfigEntry& entry : added_) {
        const std::string name = "--" + entry.key + ":";
        const std::size_t at = refused.find(name); // -t,--threads: has a short name before it
        if (at == 0 || (at < refused.find(' ') && refused[at - 1] == ','))
            throw InputError(path_, entry.line, refused.substr(at + 2));
    }
}

} // namespace hemilux
