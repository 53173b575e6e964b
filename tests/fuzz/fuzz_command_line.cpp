// Any lines as the arguments of the program: understood, or refused by one of its two errors.

#include "app/command_line/options.h"
#include "app/commands/density.h"
#include "app/commands/formfactors.h"
#include "app/settings/exit_code.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace hemilux;

/// The subcommands with what they fill; made once, as that takes far longer than parsing.
class Program {
  public:
    Program() {
        program_.require_subcommand(1);
        add_solve_command(program_, now_.solve);
        add_compare_command(program_, now_.compare);
        add_density_command(program_, now_.density);
        add_formfactors_command(program_, now_.formfactors);
        add_info_command(program_, now_.info);
        fresh_ = now_;
    }

    void parse(const std::vector<const char*>& arguments) {
        now_ = fresh_;
        try {
            program_.parse(static_cast<int>(arguments.size()), arguments.data());
        } catch (const CLI::ParseError&) {
        } catch (const UsageError&) {
        }
    }

  private:
    struct Settings {
        SolveSettings solve;
        CompareSettings compare;
        DensitySettings density;
        FormFactorSettings formfactors;
        InfoSettings info;
    };
    CLI::App program_{"", "hemilux"};
    Settings now_, fresh_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Program program;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> words{"hemilux"};
    for (std::string line; std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));
    std::vector<const char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(word.c_str());
    program.parse(arguments);
    return 0;
}
