// The command-line program: hemilux SUBCOMMAND ...

#include "app/command_line/arguments.h"
#include "app/command_line/config_words.h"
#include "app/command_line/generated/generated_texts.h"
#include "app/command_line/solving_options.h"
#include "app/memory/memory.h"
#include "app/memory/own_stack.h"
#include "app/ranks/started_ranks.h"
#include "app/running/signals.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/names.h"
#include "app/subcommands/subcommand.h"
#include "app/terminal/log.h"
#include "app/terminal/print.h"
#include "io/files/error.h"
#include "io/files/printable.h"
#include "radiosity/engine/solving/method.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace hemilux {
namespace {

/// Keeps freed memory in the process. Each step frees arrays of megabytes and takes them again. To
/// give their pages back and ask for new ones costs up to a twentieth of a short run.
void keep_freed_memory() {
#if defined(__GLIBC__)
    (void)mallopt(M_MMAP_THRESHOLD, 1 << 25); // the largest that it takes
    (void)mallopt(M_TRIM_THRESHOLD, 1 << 26);
#endif
}

/// Returns the arguments after the program's name; `help`, `help SUBCOMMAND` and `help SUBCOMMAND
/// METHOD` are --help in other words, and no argument is -h.
std::vector<std::string> arguments_of(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (words.empty())
        return {"-h"};
    if (words.front() == "help") {
        words.erase(words.begin());
        const bool of_command = !words.empty() && !words.front().starts_with('-');
        words.insert(of_command ? words.begin() + 1 : words.end(), "--help");
    }
    return words;
}

/// Returns whether a word names a file, as no subcommand does, and so a model to light.
bool names_model(const std::string& word) {
    constexpr auto extensions =
        std::to_array<std::string_view>({".obj", ".gltf", ".glb", ".stl", ".vs3"});
    std::error_code ignored;
    return !word.starts_with('-') &&
           (std::ranges::find(extensions, extension_of(word)) != extensions.end() ||
            (word.find_first_of("./") != std::string::npos &&
             std::filesystem::is_regular_file(word, ignored)));
}

/// Returns the answer to --print, made from what was declared.
std::string printed(const Arguments& program, const std::string& name) {
    const std::vector<std::string> names = {"man", "bash", "zsh", "fish"};
    if (std::ranges::find(names, name) == names.end())
        throw UsageError("--print: " + unknown_name("choice", name, names));
    if (name == names.front())
        return manual_page(program.described(), "hemilux " HEMILUX_VERSION);
    std::vector<std::string> method_names;
    for (const Method* const method : methods())
        method_names.emplace_back(method->name);
    return completions(name, program.described(), method_names);
}

/// Returns what Arguments::parse returns. Throws InputError where a file of --config is to blame.
std::string parsed(Arguments& program, const ConfigWords& config) {
    try {
        return program.parse(config.words());
    } catch (const UsageError& error) {
        config.explain(error.what());
        throw;
    }
}

/// Runs the program. `advice` names the help of the subcommand, where one is asked for.
int run_program(std::vector<std::string> words, const Ranks& ranks, std::string& advice) {
    Arguments program("hemilux", "hemilux " HEMILUX_VERSION
                                 ": the diffuse light of a 3D model, with its error");
    program.program().add_help("print this");
    program.program().add_version("-V,--version", "hemilux " HEMILUX_VERSION, "print the version");
    const auto [list, model, others] = subcommands();
    const bool lights_model = names_model(words.front());
    std::vector<Subcommand> added;
    for (const AddSubcommand add : list)
        added.push_back((lights_model && add == list.front() ? model : add)(program, ranks));
    program.program().add_answer(
        "--print", "man|bash|zsh|fish", "print the manual page, or the completions of a shell",
        [&program](const std::string& name) { return printed(program, name); });
    program.program().end_help_with(
        "hemilux MODEL [OPTIONS]       lights a model and writes a picture of it; it takes the "
        "options of solve\n\nhemilux SUBCOMMAND -h says more, hemilux SUBCOMMAND --help all.");
    if (lights_model)
        words.insert(words.begin(), "solve");
    if (const auto text = method_help(words, program.described())) {
        print(*text);
        return exit_done;
    }
    if (std::ranges::count(program.commands(), words.front()) > 0)
        advice = "\nhemilux " + words.front() + " --help says what can be asked for.";
    else if (!words.front().starts_with('-'))
        words.resize(1); // which is refused, also where help is asked for it
    advice += others;
    const ConfigWords config(std::move(words), program.described());
    if (const std::string text = parsed(program, config); !text.empty()) {
        print(text);
        return exit_done;
    }
    return std::ranges::find_if(added, &Command::parsed, &Subcommand::command)->run();
}

/// Runs the program; every error ends here, as one message and an exit code.
int guarded_main(int argc, const char* const* argv) {
    std::string advice = "\nhemilux --help says what can be asked for.";
    std::optional<StartedRanks> started;
    const auto fail = [&](int code, const char* message, const char* more = "") {
        write_message(std::string("hemilux: ") + message + more);
        if (started)
            started->fail(code, printable_message(message));
        return code;
    };
    try {
        started.emplace();
        return started->end(run_program(arguments_of(argc, argv), started->ranks(), advice));
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
    hemilux::bound_inputs({});
    return hemilux::on_own_stack([&] { return hemilux::guarded_main(argc, argv); });
}
