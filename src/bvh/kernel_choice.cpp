#include "bvh/kernel_choice.h"

#include <cstdlib>
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

std::vector<const Kernels*> find_available() {
    std::vector<const Kernels*> found;
#if defined(HEMILUX_X86_KERNELS)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        found.push_back(&avx512::kernels);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        found.push_back(&avx2::kernels);
#endif
    found.push_back(&baseline::kernels);
    return found;
}

const Kernels* named(std::string_view name) {
    for (const Kernels* kernels : available_kernels())
        if (name == kernels->name)
            return kernels;
    return nullptr;
}

} // namespace

std::span<const Kernels* const> available_kernels() {
    static const std::vector<const Kernels*> available = find_available();
    return available;
}

const Kernels& find_kernels(std::string_view name) {
    if (name.empty()) {
        const char* wanted = std::getenv("HEMILUX_KERNELS");
        const Kernels* kernels = wanted ? named(wanted) : nullptr;
        return kernels ? *kernels : *available_kernels().front();
    }
    if (const Kernels* kernels = named(name))
        return *kernels;
    throw std::invalid_argument("no ray kernels named " + std::string(name) + " on this machine");
}

} // namespace hemilux::wide
