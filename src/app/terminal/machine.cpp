#include "app/terminal/machine.h"

#include "parallel/instruction_set.h"
#include "radiosity/answers/asked/text.h"

#include <fstream>
#include <sys/utsname.h>
#include <thread>

namespace hemilux {
namespace {

/// Returns the processor as Linux names it in /proc/cpuinfo; empty elsewhere.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (const std::size_t colon = line.find(": ");
            line.starts_with("model name") && colon != line.npos)
            return line.substr(colon + 2);
    return {};
}

} // namespace

std::string machine_text() {
    std::string text;
    if (utsname system{}; uname(&system) == 0)
        text = std::string(system.sysname) + " " + system.machine + ", ";
    if (const std::string name = processor(); !name.empty())
        text += name + ", ";
    if (const unsigned threads = std::thread::hardware_concurrency(); threads > 0)
        text += counted(threads, "thread", "threads") + ", ";
    return text + "kernels: " + std::string(name_of(chosen_instruction_set()));
}

} // namespace hemilux
