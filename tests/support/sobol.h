#pragma once
#include "radiosity/engine/sampling/sobol.h"

namespace hemilux::test {

/// Point `index` of the sequence of a seed.
inline std::array<double, 4> sobol4(std::uint32_t index, std::uint64_t seed) {
    return SobolBlocks<4>(seed).at(index);
}

} // namespace hemilux::test
