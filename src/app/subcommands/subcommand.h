#pragma once
// The subcommands of a program, as a list: a program with fewer of them is linked with another
// list.

#include "app/command_line/arguments.h"
#include "app/memory/memory.h"
#include "io/files/provenance.h"
#include "parallel/ranks.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

namespace hemilux {

/// A subcommand whose options were added to the program.
struct Subcommand {
    Command command;
    std::function<int()> run; ///< returns the exit code; called once the arguments were parsed
};
using AddSubcommand = Subcommand (*)(Arguments& program, const Ranks& ranks);

struct Subcommands {
    std::span<const AddSubcommand> list; ///< in the order of --help, the first is `solve`
    AddSubcommand model;                 ///< what stands for it in `hemilux MODEL`
    std::string_view others;             ///< how to come by those it lacks; empty: it lacks none
};
/// Returns the subcommands of this program.
[[nodiscard]] Subcommands subcommands();

/// Returns what a result depends on. Where it goes, how many threads work and what is reported
/// meanwhile would give files of the same result different bytes.
[[nodiscard]] Provenance provenance(const Command& command, std::uint64_t seed);

/// Adds a subcommand by `add`, with settings that live as long as it and that `work` gets.
template <class Settings, Command (*add)(Arguments&, Settings&), auto work>
Subcommand subcommand(Arguments& program, [[maybe_unused]] const Ranks& ranks) {
    const auto settings = std::make_shared<Settings>();
    if constexpr (requires { settings->ranks; })
        settings->ranks = &ranks;
    const Command command = add(program, *settings);
    const auto run = [=] {
        std::uint64_t seed = 0;
        if constexpr (requires { settings->options; })
            seed = settings->options.seed;
        if constexpr (requires { settings->scene; })
            if (settings->scene.memory)
                bound_inputs(settings->scene.memory);
        if constexpr (requires { settings->from; })
            settings->from = provenance(command, seed);
        if constexpr (requires { settings->given; })
            settings->given = command.options_given();
        return work(*settings);
    };
    return {command, run};
}

} // namespace hemilux
