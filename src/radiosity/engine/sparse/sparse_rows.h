#pragma once
// Stores a symmetric sparse matrix by its rows.

#include "parallel/workers.h"
#include "radiosity/engine/sparse/entry_words.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

class SparseRows {
  public:
    SparseRows() = default;
    /// Allocates room for so many entries in each row, of values up to `largest`; they are still to
    /// be written.
    SparseRows(std::vector<std::uint32_t> sizes, float largest);
    /// Makes the mean of a few of the same shape, each column once in a row; it is symmetric to the
    /// last bit if they are. It takes little more memory than they have, as it takes the place of
    /// their rows.
    SparseRows(std::vector<SparseRows> parts, const Workers& workers);

    [[nodiscard]] std::size_t rows() const { return begin_.size(); }
    [[nodiscard]] std::size_t entries() const { return entries_; }
    /// Returns a row. Its entries have any order, and a column may come twice.
    [[nodiscard]] std::span<const std::uint32_t> row(std::size_t i) const {
        return {begin_[i], size_[i]};
    }
    [[nodiscard]] std::uint32_t* to_write(std::size_t i) { return begin_[i]; }
    /// Returns how rows hold their entries.
    [[nodiscard]] const EntryWords& words() const { return words_; }

    /// The number of rows that a thread takes at a time.
    static constexpr std::size_t rows_per_chunk = 64;

  private:
    [[nodiscard]] std::size_t chunks() const {
        return (size_.size() + rows_per_chunk - 1) / rows_per_chunk;
    }
    void allocate(std::size_t chunk);

    EntryWords words_;
    std::vector<std::uint32_t*> begin_;
    std::vector<std::uint32_t> size_;
    std::vector<std::unique_ptr<std::uint32_t[]>> stored_; ///< a chunk of rows each
    std::size_t entries_ = 0;
};

} // namespace hemilux
