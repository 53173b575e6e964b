#pragma once
// Packs the entries of a symmetric sparse matrix into words of 32 bits.

#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace hemilux {

/// A word holds a column in its low bits and above it the highest bits of the value, a float from
/// `largest` down to 2^-62 of it. Six of them are its exponent, so 6 are left of its fraction with
/// a million columns, and 16 with a thousand.
///
/// Values are rounded up or down at random, so that their mean over many entries is right. They
/// stand for a few rays each, and what chance makes of these is far more than what rounding does.
/// Row and column draw the number that decides, in any order: a symmetric matrix stays symmetric.
class EntryWords {
  public:
    EntryWords() = default;
    /// Throws std::length_error for more than 2^26 columns.
    EntryWords(std::size_t columns, float largest) {
        if (columns > std::size_t{1} << 26)
            throw std::length_error("a matrix has more than 67 108 864 columns");
        bits_ = std::max(static_cast<unsigned>(std::bit_width(columns > 0 ? columns - 1 : 0)), 3u);
        format_.columns = (1u << bits_) - 1;
        constexpr std::uint32_t one = 1u << fraction_bits; // of the exponent
        const std::uint32_t above = (std::bit_cast<std::uint32_t>(largest) | (one - 1)) + 1;
        format_.least = std::max(above, values + one) - values;
    }

    /// Packs an entry of a row, which stands in the row `column` too.
    [[nodiscard]] std::uint32_t pack(std::uint32_t row, std::uint32_t column, float value) const {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t size = std::max(bits, format_.least) - format_.least;
        const std::uint64_t pair =
            std::uint64_t{std::max(row, column)} << 32 | std::min(row, column);
        const auto random = static_cast<std::uint32_t>(mix_bits(pair));
        const std::uint32_t rounded = std::min(size + (random & format_.columns >> 3), values - 1);
        return (rounded << 3 & ~format_.columns) | column;
    }
    [[nodiscard]] std::uint32_t column(std::uint32_t word) const { return word & format_.columns; }
    [[nodiscard]] float value(std::uint32_t word) const {
        return std::bit_cast<float>(((word & ~format_.columns) >> 3) + format_.least);
    }
    /// Returns the same for the kernels.
    [[nodiscard]] const EntryFormat& format() const { return format_; }

  private:
    static constexpr unsigned fraction_bits = 23;
    /// The number of floats of six exponents.
    static constexpr std::uint32_t values = 1u << 29;

    unsigned bits_ = 3;
    EntryFormat format_{7, 0};
};

} // namespace hemilux
