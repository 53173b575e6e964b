#include "parallel/instruction_set.h"

#include <array>
#include <cstdlib>
#include <vector>

namespace hemilux {
namespace {

std::vector<InstructionSet> find_available() {
    std::vector<InstructionSet> found;
#if defined(HEMILUX_X86_KERNELS)
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        found.push_back(InstructionSet::avx512);
    if (avx2)
        found.push_back(InstructionSet::avx2);
#endif
    found.push_back(InstructionSet::baseline);
    return found;
}

} // namespace

std::string_view name_of(InstructionSet set) {
    constexpr std::array<std::string_view, 3> names{"baseline", "avx2", "avx512"};
    return names[static_cast<std::size_t>(set)];
}

std::span<const InstructionSet> available_instruction_sets() {
    static const std::vector<InstructionSet> available = find_available();
    return available;
}

InstructionSet chosen_instruction_set() {
    if (const char* wanted = std::getenv("HEMILUX_KERNELS"))
        for (const InstructionSet set : available_instruction_sets())
            if (name_of(set) == wanted)
                return set;
    return available_instruction_sets().front();
}

} // namespace hemilux
