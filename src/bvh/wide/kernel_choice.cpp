#include "bvh/wide/kernel_choice.h"

#include "geometry/instruction_set.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace hemilux::wide {

namespace baseline {
extern const Kernels kernels;
}
namespace avx2 {
extern const Kernels kernels;
}
namespace avx512 {
extern const Kernels kernels;
}

namespace {

const Kernels* kernels_of(InstructionSet set) {
#if defined(HEMILUX_X86_KERNELS)
    if (set == InstructionSet::avx512)
        return &avx512::kernels;
    if (set == InstructionSet::avx2)
        return &avx2::kernels;
#else
    (void)set; // there is but one
#endif
    return &baseline::kernels;
}

std::vector<const Kernels*> find_available() {
    std::vector<const Kernels*> found;
    for (const InstructionSet set : available_instruction_sets())
        found.push_back(kernels_of(set));
    return found;
}

} // namespace

std::span<const Kernels* const> available_kernels() {
    static const std::vector<const Kernels*> available = find_available();
    return available;
}

const Kernels& find_kernels(std::string_view name) {
    if (name.empty())
        return *kernels_of(chosen_instruction_set());
    for (const Kernels* kernels : available_kernels())
        if (name == kernels->name)
            return *kernels;
    throw std::invalid_argument("no ray kernels named " + std::string(name) + " on this machine");
}

} // namespace hemilux::wide
