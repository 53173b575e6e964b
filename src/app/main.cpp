// The command-line program: hemilux SUBCOMMAND ...

#include "app/command_line/options.h"
#include "app/commands/commands.h"
#include "app/commands/density.h"
#include "app/commands/formfactors.h"
#include "app/running/signals.h"
#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "io/files/error.h"
#include "io/files/printable.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace hemilux {
namespace {

/// Each step frees arrays of megabytes and takes them again. To give their pages back and ask for
/// new ones meanwhile costs up to a twentieth of a short run.
void keep_freed_memory() {
#if defined(__GLIBC__)
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 25); // the largest that it takes
    (void)mallopt(M_TRIM_THRESHOLD, 1 << 26);
#endif
}

int fail(int code, const char* message, const char* advice = "") {
    std::fprintf(stderr, "hemilux: %s%s\n", printable_message(message).c_str(), advice);
    return code;
}

/// What the parser did not understand, with the nearest name that it would.
std::string unknown_argument(const CLI::App& program, const std::string& otherwise) {
    const std::vector<CLI::App*> parsed = program.get_subcommands();
    const CLI::App& command = parsed.empty() ? program : *parsed.front();
    const std::vector<std::string> left = command.remaining();
    if (left.empty())
        return otherwise;
    const bool is_option = left.front().starts_with("-");
    if (!is_option && !parsed.empty())
        return otherwise;
    std::vector<std::string> names;
    if (is_option)
        for (const CLI::Option* const option : command.get_options())
            for (const std::string& name : option->get_lnames())
                names.push_back("--" + name);
    else
        for (const CLI::App* const subcommand : program.get_subcommands({}))
            names.push_back(subcommand->get_name());
    const std::string word = left.front().substr(0, left.front().find('='));
    return unknown_name(is_option ? "option" : "subcommand", word, names);
}

/// The option of a message of the parser, which begins with one of its names; or nullptr.
const CLI::Option* option_of(const CLI::App& command, const std::string& message) {
    return command.get_option_no_throw(message.substr(0, message.find(':')));
}

/// What the parser did not take, in this program's words.
std::string refused(const CLI::App& program, const CLI::ParseError& error) {
    const std::vector<CLI::App*> parsed = program.get_subcommands();
    if (parsed.empty() && dynamic_cast<const CLI::RequiredError*>(&error)) {
        std::string names;
        for (const CLI::App* const subcommand : program.get_subcommands({}))
            names += (names.empty() ? "" : ", ") + subcommand->get_name();
        return "expected a subcommand, one of " + names;
    }
    const CLI::App& command = parsed.empty() ? program : *parsed.front();
    const std::string message = error.what();
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

/// The arguments after the program's name; `help` and `help SUBCOMMAND` are --help in other words.
std::vector<std::string> arguments_of(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (!words.empty() && words.front() == "help") {
        words.erase(words.begin());
        words.emplace_back("--help");
    }
    return words;
}

/// `advice` names the help of the subcommand, where one is asked for.
int run_program(std::vector<std::string> words, std::string& advice) {
    CLI::App program("hemilux " HEMILUX_VERSION
                     ": radiosity by hemisphere subdivision, and the methods around it",
                     "hemilux");
    SolveSettings solve_settings;
    CompareSettings compare_settings;
    DensitySettings density_settings;
    FormFactorSettings formfactor_settings;
    InfoSettings info_settings;
    program.set_version_flag("-V,--version", "hemilux " HEMILUX_VERSION);
    program.require_subcommand(1);
    const CLI::App* const solve_command = add_solve_command(program, solve_settings);
    const CLI::App* const compare_command = add_compare_command(program, compare_settings);
    const CLI::App* const density_command = add_density_command(program, density_settings);
    const CLI::App* const formfactors_command =
        add_formfactors_command(program, formfactor_settings);
    add_info_command(program, info_settings);
    program.footer("hemilux SUBCOMMAND --help tells more.");
    for (const CLI::App* const subcommand : program.get_subcommands({}))
        if (!words.empty() && words.front() == subcommand->get_name())
            advice = "\nhemilux " + words.front() + " --help tells what can be asked for.";
    try {
        std::ranges::reverse(words); // as the parser takes them
        program.parse(std::move(words));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) { // --help and --version
            const int code = program.exit(error);
            if (!std::cout.flush())
                throw OutputError("standard output", "cannot be written");
            return code;
        }
        throw UsageError(unknown_argument(program, refused(program, error)));
    }
    if (solve_command->parsed())
        return solve(solve_settings);
    if (compare_command->parsed())
        return compare(compare_settings);
    if (density_command->parsed())
        return density(density_settings);
    if (formfactors_command->parsed())
        return formfactors(formfactor_settings);
    return info(info_settings);
}

/// Every error ends here, as one message and an exit code.
int guarded_main(int argc, const char* const* argv) {
    std::string advice = "\nhemilux --help tells what can be asked for.";
    try {
        return run_program(arguments_of(argc, argv), advice);
    } catch (const UsageError& error) {
        return fail(exit_usage, error.what(), advice.c_str());
    } catch (const InputError& error) {
        return fail(exit_input, error.what());
    } catch (const std::bad_alloc&) {
        return fail(exit_output, "there is not enough memory");
    } catch (const std::exception& error) {
        return fail(exit_output, error.what());
    }
}

} // namespace
} // namespace hemilux

int main(int argc, char** argv) {
    hemilux::prepare_process();
    hemilux::keep_freed_memory();
    return hemilux::guarded_main(argc, argv);
}
