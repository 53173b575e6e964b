// Any lines as the arguments of the program: understood, or refused by one of its two errors.

#include "app/density.h"
#include "app/exit_code.h"
#include "app/formfactors.h"
#include "app/options.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace hemilux;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
    std::vector<std::string> words{"hemilux"};
    for (std::string line; std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));
    std::vector<const char*> arguments;
    for (const std::string& word : words)
        arguments.push_back(word.c_str());
    SolveSettings solve;
    CompareSettings compare;
    DensitySettings density;
    FormFactorSettings formfactors;
    InfoSettings info;
    CLI::App program("", "hemilux");
    program.require_subcommand(1);
    add_solve_command(program, solve);
    add_compare_command(program, compare);
    add_density_command(program, density);
    add_formfactors_command(program, formfactors);
    add_info_command(program, info);
    try {
        program.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::ParseError&) {
    } catch (const UsageError&) {
    }
    return 0;
}
