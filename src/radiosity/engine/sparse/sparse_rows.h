#pragma once
// Stores a sparse matrix by its rows.

#include "parallel/workers.h"
#include "radiosity/engine/sampling/sampling_kernels.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

/// The bytes per entry of a sparse matrix of form factors at its peak: column, value, and the
/// counts that they come from, with room to grow.
inline constexpr double bytes_per_factor = 32;

class SparseRows {
  public:
    SparseRows() = default;
    /// Allocates room for so many entries in each row; they are still to be written.
    explicit SparseRows(std::vector<std::uint32_t> sizes);
    /// Makes the mean of a few of the same shape, each column once in a row; it is symmetric to the
    /// last bit if they are. It takes little more memory than they have, as it takes the place of
    /// their rows.
    SparseRows(std::vector<SparseRows> parts, const Workers& workers);

    [[nodiscard]] std::size_t rows() const { return begin_.size(); }
    [[nodiscard]] std::size_t entries() const { return entries_; }
    /// Returns a row. Its entries have any order, and a column may come twice.
    [[nodiscard]] std::span<const MatrixEntry> row(std::size_t i) const {
        return {begin_[i], size_[i]};
    }
    [[nodiscard]] MatrixEntry* to_write(std::size_t i) { return begin_[i]; }

    /// The number of rows that a thread takes at a time.
    static constexpr std::size_t rows_per_chunk = 64;

  private:
    [[nodiscard]] std::size_t chunks() const {
        return (size_.size() + rows_per_chunk - 1) / rows_per_chunk;
    }
    void allocate(std::size_t chunk);

    std::vector<MatrixEntry*> begin_;
    std::vector<std::uint32_t> size_;
    std::vector<std::unique_ptr<MatrixEntry[]>> stored_; ///< a chunk of rows each
    std::size_t entries_ = 0;
};

} // namespace hemilux
