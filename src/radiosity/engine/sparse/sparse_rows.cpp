#include "radiosity/engine/sparse/sparse_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// Adds up rows. The order of the columns is that in which they come. Some floats of similar size
/// sum up to a double without rounding, so the sums are symmetric too.
class Accumulator {
  public:
    explicit Accumulator(std::size_t columns, const EntryWords& words)
        : words_(words), sum_(columns), touched_(columns + 1) {}

    void add(std::uint32_t word) {
        const std::uint32_t column = words_.column(word);
        double& sum = sum_[column];
        touched_[count_] = column; // for good if it is a new one: no branch could be foreseen
        count_ += !(sum > 0);
        sum += static_cast<double>(words_.value(word));
    }
    /// Adds all sums, times a factor, to the entries of a row, and empties the accumulator.
    void flush(std::uint32_t row, double factor, std::vector<std::uint32_t>& entries) {
        for (std::size_t k = 0; k < count_; ++k) {
            const double sum = std::exchange(sum_[touched_[k]], 0.0);
            entries.push_back(words_.pack(row, touched_[k], static_cast<float>(factor * sum)));
        }
        count_ = 0;
    }

  private:
    EntryWords words_;
    std::vector<double> sum_;
    std::vector<std::uint32_t> touched_;
    std::size_t count_ = 0;
};

} // namespace

SparseRows::SparseRows(std::vector<std::uint32_t> sizes, float largest)
    : words_(sizes.size(), largest), begin_(sizes.size()), size_(std::move(sizes)),
      stored_(chunks()) {
    for (std::size_t c = 0; c < stored_.size(); ++c)
        allocate(c);
    entries_ = std::accumulate(size_.begin(), size_.end(), std::size_t{0});
}

/// Allocates rows whose sizes are known.
void SparseRows::allocate(std::size_t chunk) {
    const std::size_t begin = chunk * rows_per_chunk;
    const std::size_t end = std::min(begin + rows_per_chunk, size_.size());
    std::size_t entries = 0;
    for (std::size_t i = begin; i < end; ++i)
        entries += size_[i];
    stored_[chunk] = std::make_unique_for_overwrite<std::uint32_t[]>(entries);
    std::uint32_t* next = stored_[chunk].get();
    for (std::size_t i = begin; i < end; next += size_[i++])
        begin_[i] = next;
}

SparseRows::SparseRows(std::vector<SparseRows> parts, const Workers& workers)
    : words_(parts[0].words()), begin_(parts[0].rows()), size_(parts[0].rows()), stored_(chunks()) {
    struct Scratch {
        Accumulator sum;
        std::vector<std::uint32_t> rows;
    };
    workers.for_chunks_with(
        rows(), rows_per_chunk,
        [&] {
            return Scratch{Accumulator(rows(), words_), {}};
        },
        [&](Scratch& scratch, std::size_t begin, std::size_t end) {
            scratch.rows.clear();
            for (std::size_t i = begin; i < end; ++i) {
                for (const SparseRows& part : parts)
                    for (const std::uint32_t word : part.row(i))
                        scratch.sum.add(word);
                const std::size_t before = scratch.rows.size();
                scratch.sum.flush(static_cast<std::uint32_t>(i),
                                  1 / static_cast<double>(parts.size()), scratch.rows);
                size_[i] = static_cast<std::uint32_t>(scratch.rows.size() - before);
            }
            const std::size_t chunk = begin / rows_per_chunk;
            for (SparseRows& part : parts)
                part.stored_[chunk].reset();
            allocate(chunk);
            std::ranges::copy(scratch.rows, begin_[begin]);
        });
    entries_ = std::accumulate(size_.begin(), size_.end(), std::size_t{0});
}

} // namespace hemilux
