#pragma once
// Kinds of options, on top of CLI11's: numbers with a range, values with a text form of their own,
// options that may be repeated. Their messages name the option and what it expects.

#include "app/settings/exit_code.h"
#include "app/settings/numbers.h"

#include <CLI/CLI.hpp>

namespace hemilux {

/// An option whose value is read by `parse`, which returns an optional; empty means that the text
/// is not what was `expected`.
template <class Parse, class Store>
CLI::Option* add_parsed(CLI::App& app, const std::string& name, const std::string& type,
                        const std::string& help, const std::string& expected, Parse parse,
                        Store store) {
    const auto read_all = [=](const CLI::results_t& texts) {
        for (const std::string& text : texts) {
            const auto value = parse(text);
            if (!value)
                throw UsageError(name + ": expected " + expected + ", not '" + text + "'");
            store(*value);
        }
        return true;
    };
    return app.add_option(name, read_all, help)->type_name(type);
}

/// The option may be given several times, with one value each time.
inline CLI::Option* repeatable(CLI::Option* option) {
    return option->expected(1, CLI::detail::expected_max_vector_size)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

template <class Target>
CLI::Option* add_number(CLI::App& app, const std::string& name, const std::string& type,
                        Target& target, const NumberRange& range, const std::string& help) {
    const auto parse = [range](const std::string& text) {
        const std::optional<double> value = parse_number(text);
        return value && range.contains(*value) ? value : std::nullopt;
    };
    return add_parsed(app, name, type, help, "a number " + range.text(), parse,
                      [&target](double value) { target = value; });
}

template <class Whole, class Target>
CLI::Option* add_whole(CLI::App& app, const std::string& name, Target& target, std::uint64_t low,
                       std::uint64_t high, const std::string& help) {
    const auto parse = [low, high](const std::string& text) {
        const auto value = parse_whole(text);
        return value && *value >= low && *value <= high ? value : std::nullopt;
    };
    const std::string expected =
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    return add_parsed(app, name, "N", help, expected, parse,
                      [&target](std::uint64_t value) { target = static_cast<Whole>(value); });
}

} // namespace hemilux
