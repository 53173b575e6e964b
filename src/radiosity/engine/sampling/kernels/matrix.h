// Multiplies the rows of a sparse matrix. There is no #pragma once: the file is included once per
// instruction set, into a namespace of its own.

#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux::HEMILUX_KERNELS {

inline void add_product(std::uint32_t word, EntryFormat format, const Lanes* x, double* sum) {
    const double value = __builtin_bit_cast(float, ((word & ~format.columns) >> 2) + format.least);
    const double* lane = x[word & format.columns].lane;
    for (int c = 0; c < 4; ++c)
        sum[c] += value * lane[c];
}

/// Adds up in two sums that do not wait for each other.
inline void row_times(const std::uint32_t* row, std::size_t count, EntryFormat format,
                      const Lanes* x, Lanes* sum) {
    double even[4] = {}, odd[4] = {};
    std::size_t k = 0;
    for (; k + 2 <= count; k += 2) {
        add_product(row[k], format, x, even);
        add_product(row[k + 1], format, x, odd);
    }
    if (k < count)
        add_product(row[k], format, x, even);
    for (int c = 0; c < 4; ++c)
        sum->lane[c] = even[c] + odd[c];
}

} // namespace hemilux::HEMILUX_KERNELS
