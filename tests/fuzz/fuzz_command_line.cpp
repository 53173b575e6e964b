// Any lines as the arguments of the program: understood, or refused by its error.

#include "app/command_line/options.h"
#include "app/settings/exit_code.h"
#include "app/settings/view_factor_settings.h"

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
        add_solve_command(program_, now_.solve);
        add_bake_command(program_, now_.bake);
        add_compare_command(program_, now_.compare);
        add_density_command(program_, now_.density);
        add_formfactors_command(program_, now_.formfactors);
        add_viewfactors_command(program_, now_.viewfactors);
        add_info_command(program_, now_.info);
        fresh_ = now_;
    }

    void parse(const std::vector<std::string>& words) {
        now_ = fresh_;
        try {
            (void)program_.parse(words);
        } catch (const UsageError&) {
        }
    }

  private:
    struct Settings {
        SolveSettings solve, bake;
        CompareSettings compare;
        DensitySettings density;
        FormFactorSettings formfactors;
        ViewFactorSettings viewfactors;
        InfoSettings info;
    };
    Arguments program_{"hemilux", ""};
    Settings now_, fresh_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static Program program;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> words;
    for (std::string line; std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));
    program.parse(words);
    return 0;
}
