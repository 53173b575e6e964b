// Computes points of an Owen-scrambled Sobol sequence (radiosity/engine/sampling/sobol.h). There is
// no #pragma once: the file is included once per instruction set, into a namespace of its own.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

/// Hashes a word so that each bit depends on itself and lower bits only: on reversed words this is
/// a nested uniform scrambling. The constants are those of Vegdahl (2021, "Building a better LK
/// hash").
inline std::uint32_t permute(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

inline std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

inline void sobol(const SobolBlockStart& start, const SobolSteps& steps, std::size_t dimensions,
                  double* out) {
    for (std::size_t d = 0; d < dimensions; ++d) {
        const std::uint32_t seed = start.seeds[d], first = start.first[d];
        const std::uint32_t* step = steps.step[d];
        double* to = out + samples_per_block * d;
        for (std::size_t k = 0; k < samples_per_block; ++k)
            to[k] =
                (static_cast<double>(reverse_bits(permute(first ^ step[k], seed))) + 0.5) * 0x1p-32;
    }
}

} // namespace hemilux::HEMILUX_KERNELS
