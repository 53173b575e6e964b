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
/// `largest` down to 2^-126 of it. Seven of them are its exponent, so 5 are left of its fraction
/// with a million columns, and 15 with a thousand.
///
/// Values are rounded up or down at random, so that their mean over many entries is right. They
/// stand for a few rays each, and what chance makes of these is far more than what rounding does.
/// Row and column draw the number that decides, in any order: a symmetric matrix stays symmetric.
class EntryWords {
  public:
    EntryWords() = default;
    /// Throws std::length_error for more than 2^25 columns.
    EntryWords(std::size_t columns, float largest) {
        if (columns > std::size_t{1} << 25)
            throw std::length_error("a matrix has more than 33 554 432 columns");
        const int bits = std::max(int(std::bit_width(columns > 0 ? columns - 1 : 0)), 2);
        format_.columns = (1u << bits) - 1;
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
        const std::uint32_t rounded = std::min(size + (random & format_.columns >> 2), values - 1);
        return (rounded << 2 & ~format_.columns) | column;
    }
    [[nodiscard]] std::uint32_t column(std::uint32_t word) const { return word & format_.columns; }
    [[nodiscard]] float value(std::uint32_t word) const {
        return std::bit_cast<float>(((word & ~format_.columns) >> 2) + format_.least);
    }
    /// Returns the same for the kernels.
    [[nodiscard]] const EntryFormat& format() const { return format_; }

  private:
    static constexpr unsigned fraction_bits = 23;
    /// The number of floats of 128 exponents.
    static constexpr std::uint32_t values = 1u << 30;

    EntryFormat format_{3, 0};
};

} // namespace hemilux
