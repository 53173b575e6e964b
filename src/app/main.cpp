// The command-line program: hemilux SUBCOMMAND ...

#include "app/command_line/config_words.h"
#include "app/command_line/generated/generated_texts.h"
#include "app/command_line/options.h"
#include "app/command_line/solving_options.h"
#include "app/commands/commands.h"
#include "app/memory/memory.h"
#include "app/memory/own_stack.h"
#include "app/ranks/started_ranks.h"
#include "app/running/signals.h"
#include "app/settings/dim_settings.h"
#include "app/settings/exit_code.h"
#include "app/settings/extension.h"
#include "app/settings/names.h"
#include "app/settings/view_factor_settings.h"
#include "app/terminal/log.h"
#include "app/terminal/print.h"
#include "io/files/error.h"
#include "io/files/printable.h"

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

/// Returns whether a word that is no subcommand names a file, and so a model to light.
bool names_model(const std::string& word) {
    constexpr auto extensions =
        std::to_array<std::string_view>({".obj", ".gltf", ".glb", ".stl", ".vs3"});
    std::error_code ignored;
    return !word.starts_with('-') &&
           (std::ranges::find(extensions, extension_of(word)) != extensions.end() ||
            std::filesystem::is_regular_file(word, ignored));
}

/// Returns what a result depends on. Where it goes, how many threads work and what is reported
/// meanwhile would give files of the same result different bytes.
Provenance provenance(const Command& command, std::uint64_t seed) {
    constexpr auto beside = std::to_array<std::string_view>(
        {"--output", "--stats", "--steps-log", "--error-map", "--points-output", "--report",
         "--every-step", "--legend", "--threads", "--memory", "--checkpoint", "--every", "--resume",
         "--quiet", "--verbose", "--config"});
    return {"hemilux " HEMILUX_VERSION, "hemilux " + command.text_given(beside), seed};
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
    SolveSettings solve_settings, bake_settings;
    CompareSettings compare_settings;
    solve_settings.ranks = bake_settings.ranks = compare_settings.ranks = &ranks;
    DensitySettings density_settings;
    FormFactorSettings formfactor_settings;
    ViewFactorSettings viewfactor_settings, exchange_settings;
    DimSettings dim_settings;
    InfoSettings info_settings;
    program.program().add_help("print this");
    program.program().add_version("-V,--version", "hemilux " HEMILUX_VERSION, "print the version");
    const Command solve_command = add_solve_command(program, solve_settings);
    const Command bake_command = add_bake_command(program, bake_settings);
    const Command compare_command = add_compare_command(program, compare_settings);
    const Command density_command = add_density_command(program, density_settings);
    const Command formfactors_command = add_formfactors_command(program, formfactor_settings);
    const Command viewfactors_command = add_viewfactors_command(program, viewfactor_settings);
    const Command exchange_command = add_exchange_command(program, exchange_settings);
    const Command dim_command = add_dim_command(program, dim_settings);
    add_info_command(program, info_settings);
    program.program().add_answer(
        "--print", "man|bash|zsh|fish", "print the manual page, or the completions of a shell",
        [&program](const std::string& name) { return printed(program, name); });
    program.program().end_help_with(
        "hemilux MODEL [OPTIONS]       lights a model and writes a picture of it; it takes the "
        "options of solve\n\nhemilux SUBCOMMAND -h says more, hemilux SUBCOMMAND --help all.");
    const bool lights_model =
        std::ranges::count(program.commands(), words.front()) == 0 && names_model(words.front());
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
    const ConfigWords config(std::move(words), program.described());
    if (const std::string text = parsed(program, config); !text.empty()) {
        print(text);
        return exit_done;
    }
    for (const SceneSettings* const scene :
         {&solve_settings.scene, &bake_settings.scene, &compare_settings.scene,
          &density_settings.scene, &formfactor_settings.scene, &viewfactor_settings.scene,
          &exchange_settings.scene, &info_settings.scene})
        if (scene->memory) // of the command that was given
            bound_inputs(scene->memory);
    if (solve_command.parsed()) {
        solve_settings.from = provenance(solve_command, solve_settings.options.seed);
        solve_settings.given = solve_command.options_given();
        return lights_model ? light_model(solve_settings) : solve(solve_settings);
    }
    if (bake_command.parsed()) {
        bake_settings.from = provenance(bake_command, bake_settings.options.seed);
        bake_settings.given = bake_command.options_given();
        return bake_settings.file_bake.occlusion ? bake_occlusion(bake_settings)
                                                 : solve(bake_settings);
    }
    if (dim_command.parsed()) {
        dim_settings.from = provenance(dim_command, 0);
        return dim(dim_settings);
    }
    if (compare_command.parsed()) {
        compare_settings.from = provenance(compare_command, compare_settings.options.seed);
        compare_settings.given = compare_command.options_given();
        return compare(compare_settings);
    }
    if (density_command.parsed()) {
        density_settings.given = density_command.options_given();
        return density(density_settings);
    }
    if (formfactors_command.parsed()) {
        formfactor_settings.given = formfactors_command.options_given();
        return formfactors(formfactor_settings);
    }
    if (viewfactors_command.parsed()) {
        viewfactor_settings.from =
            provenance(viewfactors_command, viewfactor_settings.options.seed);
        viewfactor_settings.given = viewfactors_command.options_given();
        return viewfactors(viewfactor_settings);
    }
    if (exchange_command.parsed()) {
        exchange_settings.given = exchange_command.options_given();
        return viewfactors(exchange_settings);
    }
    return info(info_settings);
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
