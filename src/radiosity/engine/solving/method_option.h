#pragma once
// Defines an option of one method, declared in the method's own file. The command line, its checks,
// --help, --config, completions, checkpoints and statistics follow from the declaration:
//
//     struct RingOptions { bool open = false; std::uint32_t rings = 4; };
//     constexpr std::array<std::uint32_t, 3> rings{2, 4, 8};
//
//     std::vector<MethodOption> options() {
//         return {flag_option("--open", "leave the rim out", &RingOptions::open),
//                 number_option("--rings", "rings of cells [4]", &RingOptions::rings, rings)};
//     }
//
// and the method reads own_options<RingOptions>(input.options).

#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/solving/solve_options.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

struct MethodOption {
    std::string name; ///< name such as `--rings`
    std::string help; ///< one line for --help, which names the methods before it
    /// The texts that may follow it, as `density`; capitals stand for other text, as in
    /// `hemicube:N`. A flag has none.
    std::vector<std::string> values;
    /// Sets it. False, with nothing changed, for a text that is none of the values; those of a flag
    /// are "yes" and "no". Throws std::invalid_argument with what was expected where there is more
    /// to say.
    std::function<bool(SolveOptions&, std::string_view)> set;
    /// Returns its value; "yes" or "no" of a flag.
    std::function<std::string(const SolveOptions&)> get;
    bool on_page = true;         ///< the method's page (Method::plain) has it, too
    bool resumable = true;       ///< a run with it can be saved
    bool makes_variants = false; ///< `compare` takes METHOD-VALUE for a method
    std::string excludes = {};   ///< the name of another, which may not be given with it

    /// Returns whether it was changed.
    [[nodiscard]] bool is_set(const SolveOptions& options) const {
        return get(options) != get(SolveOptions{});
    }
    /// Returns the option as the user would write it.
    [[nodiscard]] std::string text(const SolveOptions& options) const {
        return values.empty() ? name : name + " " + get(options);
    }
};

/// Sets one member of a method's options.
template <class Own, class Value>
void set_own_option(SolveOptions& options, Value Own::*member, Value value) {
    Own changed = own_options<Own>(options);
    changed.*member = value;
    set_own_options(options, changed);
}

/// Makes an option that is given or not.
template <class Own>
[[nodiscard]] MethodOption flag_option(const std::string& name, const std::string& help,
                                       bool Own::*member) {
    return {.name = name,
            .help = help,
            .values = {},
            .set =
                [member](SolveOptions& options, std::string_view text) {
                    if (text != "yes" && text != "no")
                        return false;
                    set_own_option(options, member, text == "yes");
                    return true;
                },
            .get = [member](const SolveOptions& options) -> std::string {
                return own_options<Own>(options).*member ? "yes" : "no";
            }};
}

/// Makes an option with one of these whole numbers, which outlive it.
template <class Own>
[[nodiscard]] MethodOption number_option(const std::string& name, const std::string& help,
                                         std::uint32_t Own::*member,
                                         std::span<const std::uint32_t> choices) {
    std::vector<std::string> values;
    for (const std::uint32_t choice : choices)
        values.push_back(std::to_string(choice));
    return {.name = name,
            .help = help,
            .values = values,
            .set =
                [member, choices](SolveOptions& options, std::string_view text) {
                    for (const std::uint32_t choice : choices)
                        if (std::to_string(choice) == text) {
                            set_own_option(options, member, choice);
                            return true;
                        }
                    return false;
                },
            .get =
                [member](const SolveOptions& options) {
                    return std::to_string(own_options<Own>(options).*member);
                }};
}

} // namespace hemilux
