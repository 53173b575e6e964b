#pragma once
// Kinds of options: numbers with a range, and values with a text form of their own. Their messages
// name the option and what it expects.

#include "app/command_line/arguments.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/names.h"
#include "app/settings/numbers.h"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hemilux {

/// Values of a variable of this type: those of an optional are what it may hold.
template <class Target>
struct ValueOf {
    using type = Target;
};
template <class Value>
struct ValueOf<std::optional<Value>> {
    using type = Value;
};

template <class>
inline constexpr bool is_list = false;
template <class Value>
inline constexpr bool is_list<std::vector<Value>> = true;

/// Adds an option whose value is read by `parse`, which returns an optional. Empty means that the
/// text is not what was `expected`. The value is stored in a variable that outlives the parsing, or
/// in a list of them, which makes the option repeatable; or a function gets it.
template <class Parse, class Target>
Option add_parsed(Command command, const std::string& name, const std::string& type,
                  const std::string& help, const std::string& expected, Parse parse,
                  Target&& target) {
    using Value = std::remove_cvref_t<decltype(*parse(std::string()))>;
    using Stored = std::remove_cvref_t<Target>;
    const auto add = [&](auto store) {
        return command.add_values(name, type, help, [=](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
                const auto value = parse(text);
                if (!value)
                    throw UsageError(name + ": expected " + expected + ", not '" + text + "'");
                store(*value);
            }
        });
    };
    if constexpr (std::invocable<Stored, Value>)
        return add(target);
    else if constexpr (is_list<Stored>)
        return add([&target](const Value& value) { target.push_back(value); }).repeatable();
    else
        return add([&target](const Value& value) {
            target = static_cast<typename ValueOf<Stored>::type>(value);
        });
}

/// Adds an option for a number of a range, which `parse` reads.
template <class Target>
Option add_in_range(Command command, const std::string& name, const std::string& type,
                    Target& target, const NumberRange& range, const std::string& help,
                    const std::string& expected,
                    std::optional<double> (*parse)(std::string_view text)) {
    const auto parse_in_range = [range, parse](const std::string& text) {
        const std::optional<double> value = parse(text);
        return value && range.contains(*value) ? value : std::nullopt;
    };
    return add_parsed(command, name, type, help, expected, parse_in_range, target);
}

template <class Target>
Option add_number(Command command, const std::string& name, const std::string& type, Target& target,
                  const NumberRange& range, const std::string& help) {
    return add_in_range(command, name, type, target, range, help, "a number " + range.text(),
                        parse_number);
}

/// Adds an option for a time: seconds, or a number with s, m or h.
template <class Target>
Option add_seconds(Command command, const std::string& name, Target& target,
                   const NumberRange& range, const std::string& help) {
    return add_in_range(command, name, "SECONDS", target, range, help,
                        "a time " + range.text() + " such as 90, 90s, 2m or 1h", parse_seconds);
}

/// Adds an option for a relative error above 0. One of 1 or more without a % sign is a slip: 1 for
/// 1 %.
template <class Target>
Option add_error(Command command, const std::string& name, Target& target,
                 const std::string& help) {
    const auto parse = [name](const std::string& text) {
        const std::optional<double> value = parse_share(text);
        if (value && *value >= 1 && !text.ends_with('%'))
            throw UsageError(name + ": was " + text + " % meant? Write " + text +
                             "%; without the sign, 1 is an error of 100 %");
        return value && positive.contains(*value) ? value : std::nullopt;
    };
    return add_parsed(command, name, "X|PERCENT%", help, "an error above 0 such as 1% or 0.01",
                      parse, target);
}

template <class Target>
Option add_whole(Command command, const std::string& name, Target& target, std::uint64_t low,
                 std::uint64_t high, const std::string& help) {
    const auto parse = [low, high](const std::string& text) {
        const auto value = parse_whole(text);
        return value && *value >= low && *value <= high ? value : std::nullopt;
    };
    const std::string expected =
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    return add_parsed(command, name, "N", help, expected, parse, target);
}

/// A value of an enumeration and the text that stands for it.
template <class Choice>
struct NamedChoice {
    Choice value;
    const char* name;
};

/// Adds an option whose values are those of an enumeration; `store` gets the one that is named.
template <class Choice, class Store>
requires std::invocable<Store, Choice>
    Option add_choice(Command command, const std::string& name,
                      const std::vector<NamedChoice<Choice>>& choices, const std::string& help,
                      Store store) {
    std::vector<std::string> names;
    for (const NamedChoice<Choice>& choice : choices)
        names.emplace_back(choice.name);
    return command.add_value(name, joined(names, "|"), help, [=](const std::string& text) {
        const auto chosen = std::ranges::find(names, text);
        if (chosen == names.end())
            throw UsageError(name + ": " + unknown_name("choice", text, names));
        store(choices[static_cast<std::size_t>(chosen - names.begin())].value);
    });
}

template <class Target>
Option add_choice(Command command, const std::string& name, Target& target,
                  const std::vector<NamedChoice<typename ValueOf<Target>::type>>& choices,
                  const std::string& help) {
    return add_choice(command, name, choices, help, [&target](auto value) { target = value; });
}

/// Adds an option whose value is a path with one of these extensions. `extensions` names them as
/// the message does: ".svg or .png".
template <class Target>
Option add_path(Command command, const std::string& name, const std::string& type,
                const std::string& help, const std::string& extensions, Target&& target) {
    const auto parse = [extensions](const std::string& path) {
        const std::string extension = extension_of(path);
        return !extension.empty() && (extensions + " ").find(extension + " ") != std::string::npos
                   ? std::optional(path)
                   : std::nullopt;
    };
    return add_parsed(command, name, type, help, "a file name that ends with " + extensions, parse,
                      target);
}

} // namespace hemilux
