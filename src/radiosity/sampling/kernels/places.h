// Places among running sums. No #pragma once: see sobol.h.

#include "radiosity/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

/// Branch-free binary search: whichever half is taken, the next is known in time.
inline void find_places(const double* sums, std::size_t size, std::size_t count,
                        const double* __restrict at, std::uint64_t* __restrict places) {
    for (std::size_t k = 0; k < count; ++k)
        places[k] = 0;
    for (std::size_t half = size / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < count; ++k)
            places[k] += sums[places[k] + half] <= at[k] ? half : 0;
}

} // namespace hemilux::HEMILUX_KERNELS
