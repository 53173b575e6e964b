#pragma once
// Packs the counts of a sparse matrix into words of 32 bits.

#include <bit>
#include <cstddef>
#include <cstdint>

namespace hemilux {

/// A word holds a column in its low bits and a count above them. A larger count than fits takes
/// several words of one column: with a million columns a word counts up to 4095.
class CountWords {
  public:
    /// There are at most 2^31 columns.
    explicit CountWords(std::size_t columns = 0)
        : bits_(static_cast<unsigned>(std::bit_width(columns > 0 ? columns - 1 : 0))) {}

    [[nodiscard]] std::uint32_t pack(std::uint32_t column, std::uint32_t count) const {
        return count << bits_ | column;
    }
    [[nodiscard]] std::uint32_t column(std::uint32_t word) const {
        return word & ((1u << bits_) - 1);
    }
    [[nodiscard]] std::uint32_t count(std::uint32_t word) const { return word >> bits_; }
    [[nodiscard]] bool is_full(std::uint32_t word) const { return count(word) == max_count(); }
    /// Returns the largest count of a word.
    [[nodiscard]] std::uint32_t max_count() const { return ~0u >> bits_; }

  private:
    unsigned bits_;
};

} // namespace hemilux
