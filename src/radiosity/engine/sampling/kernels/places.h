// Finds places among running sums. There is no #pragma once: see sobol.h.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

/// Searches without branches, by halves: whichever half is taken, the next is known in time.
inline void find_places(const double* sums, std::size_t size, std::size_t count,
                        const double* __restrict at, std::uint64_t* __restrict places) {
    for (std::size_t k = 0; k < count; ++k)
        places[k] = 0;
    for (std::size_t half = size / 2; half > 0; half /= 2)
        for (std::size_t k = 0; k < count; ++k)
            places[k] += sums[places[k] + half] <= at[k] ? half : 0;
}

/// Finds the rays, which stand at whole numbers, without a branch and without a number of rays that
/// is not whole.
inline std::uint64_t last_rays(const PatchOnLine& line, std::size_t count,
                               const double* __restrict up_to, std::int64_t* __restrict last) {
    const double before = line.before, after = line.after, rays = line.rays, all = line.all;
    for (std::size_t k = 0; k < count; ++k) {
        const double end = before + rays * up_to[k];
        last[k + 1] = static_cast<std::int64_t>(up_to[k] < all && end < after ? end : after);
    }
    std::uint64_t with_rays = 0;
    for (std::size_t k = 0; k < count; ++k)
        with_rays |= std::uint64_t{last[k + 1] > last[k]} << k;
    return with_rays;
}

} // namespace hemilux::HEMILUX_KERNELS
