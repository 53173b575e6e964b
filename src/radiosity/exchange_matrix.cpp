#include "radiosity/exchange_matrix.h"

#include "radiosity/mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t rows_per_chunk = 64;
/// Each takes most of what is missing away. In open scenes no symmetric matrix may agree with all
/// that was lost, and no number would be enough.
constexpr int scalings = 6;

/// Chunks of rows that are merged with one accumulator.
constexpr std::size_t merging_chunks = 16;

/// Fewer entries are read sooner than other threads would be started.
constexpr std::size_t entries_for_one_thread = 400'000;

/// Puts the hits of one row together. The order of the columns is that in which they come.
class Accumulator {
  public:
    explicit Accumulator(std::size_t columns) : hits_(columns) {}

    void add(const RayCounts::Count& count) {
        if (hits_[count.patch] == 0)
            touched_.push_back(count.patch);
        hits_[count.patch] += count.hits;
    }
    /// visit(column, hits); and is empty again.
    template <class Visit>
    void flush(const Visit& visit) {
        for (const std::uint32_t column : touched_)
            visit(column, std::exchange(hits_[column], 0));
        touched_.clear();
    }

  private:
    std::vector<std::uint64_t> hits_;
    std::vector<std::uint32_t> touched_;
};

/// What other patches counted of each: the counts, transposed.
struct Incoming {
    std::vector<std::size_t> begin; ///< one more than rows
    std::vector<RayCounts::Count> counts;

    Incoming(std::span<const RayCounts> sets, std::size_t n) : begin(n + 1) {
        for_all(sets, n, [&](std::uint32_t, const auto& count) { ++begin[count.patch + 1]; });
        for (std::size_t i = 0; i < n; ++i)
            begin[i + 1] += begin[i];
        counts.resize(begin[n]);
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        for_all(sets, n, [&](std::uint32_t i, const auto& count) {
            counts[next[count.patch]++] = {i, count.hits};
        });
    }
    [[nodiscard]] std::span<const RayCounts::Count> row(std::size_t i) const {
        return std::span(counts).subspan(begin[i], begin[i + 1] - begin[i]);
    }

  private:
    template <class Visit>
    static void for_all(std::span<const RayCounts> sets, std::size_t n, const Visit& visit) {
        for (const RayCounts& set : sets)
            for (std::uint32_t i = 0; i < n; ++i)
                for (const RayCounts::Count& count : set.row(i))
                    visit(i, count);
    }
};

} // namespace

ExchangeMatrix::ExchangeMatrix(const Mesh& mesh, std::span<const RayCounts> sets,
                               const Workers& workers)
    : lost_(mesh.patches().size()) {
    for (const Patch& patch : mesh.patches())
        area_.push_back(patch.area);
    find_lost(sets);
    merge(sets, workers);
    close(find_scale(workers), workers);
}

void ExchangeMatrix::find_lost(std::span<const RayCounts> sets) {
    for (std::uint32_t i = 0; i < lost_.size(); ++i) {
        double rays = 0;
        for (const RayCounts& set : sets) {
            rays += set.rays(i);
            lost_[i].escaped += set.escaped(i);
            lost_[i].absorbed += set.absorbed(i);
        }
        if (rays > 0) {
            lost_[i].escaped /= rays;
            lost_[i].absorbed /= rays;
        }
        rays_.push_back(rays);
        rays_per_area_.push_back(area_[i] > 0 ? rays / area_[i] : 0);
    }
}

void ExchangeMatrix::merge(std::span<const RayCounts> sets, const Workers& workers) {
    const std::size_t n = area_.size();
    const Incoming incoming(sets, n);
    row_begin_.assign(n + 1, 0);
    for (std::uint32_t i = 0; i < n; ++i) {
        std::size_t most = incoming.row(i).size();
        for (const RayCounts& set : sets)
            most += set.row(i).size();
        row_begin_[i + 1] = row_begin_[i] + most;
    }
    entry_ = std::make_unique_for_overwrite<Entry[]>(row_begin_[n]);
    row_size_.resize(n);
    workers.for_chunks(n, n / merging_chunks + 1, [&](std::size_t begin, std::size_t end) {
        Accumulator sum(n);
        for (std::size_t i = begin; i < end; ++i) {
            for (const RayCounts& set : sets)
                for (const RayCounts::Count& count : set.row(static_cast<std::uint32_t>(i)))
                    sum.add(count);
            for (const RayCounts::Count& count : incoming.row(i))
                sum.add(count);
            Entry* next = &entry_[row_begin_[i]];
            sum.flush([&](std::uint32_t j, std::uint64_t hits) {
                const double worth = rays_per_area_[i] + rays_per_area_[j];
                *next++ = {j, static_cast<float>(static_cast<double>(hits) / worth)};
            });
            row_size_[i] = static_cast<std::uint32_t>(next - &entry_[row_begin_[i]]);
        }
    });
}

Workers ExchangeMatrix::readers(const Workers& workers) const {
    return row_begin_.back() < entries_for_one_thread ? Workers(1) : workers;
}

double ExchangeMatrix::due(std::size_t i) const {
    return rays_per_area_[i] > 0
               ? area_[i] * std::max(1 - lost_[i].escaped - lost_[i].absorbed, 0.0)
               : -1;
}

/// Rows are closed by c = due / (S r), then by r = due / (S c), and so on (Sinkhorn and Knopp
/// 1967). As S is symmetric, r and c end as multiples of each other, and g is their geometric mean.
std::vector<double> ExchangeMatrix::find_scale(const Workers& workers) const {
    const std::size_t n = area_.size();
    std::vector<double> scale(n, 1.0), before(n, 1.0), after(n);
    for (int k = 0; k < scalings; ++k) {
        readers(workers).for_chunks(n, rows_per_chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                double sum = 0;
                for (const auto& [j, value] : row(i))
                    sum += static_cast<double>(value) * scale[j];
                after[i] = 1; // where the patch itself has not looked, what others saw is all
                if (due(i) >= 0)
                    after[i] = sum > 0 ? due(i) / sum : 0;
            }
        });
        before = std::exchange(scale, after);
    }
    for (std::size_t i = 0; i < n; ++i)
        scale[i] = std::sqrt(scale[i] * before[i]);
    return scale;
}

void ExchangeMatrix::close(const std::vector<double>& scale, const Workers& workers) {
    self_.assign(area_.size(), 0.0);
    readers(workers).for_chunks(
        area_.size(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                double sum = 0;
                for (std::size_t e = row_begin_[i]; e < row_begin_[i] + row_size_[i]; ++e) {
                    auto& [j, value] = entry_[e];
                    value = static_cast<float>(static_cast<double>(value) * (scale[i] * scale[j]));
                    sum += static_cast<double>(value);
                }
                if (sum > 0 && due(i) >= 0)
                    self_[i] = due(i) - sum;
            }
        });
}

void ExchangeMatrix::multiply(std::span<const Vec3> x, std::span<Vec3> y,
                              const Workers& workers) const {
    readers(workers).for_chunks(y.size(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec3 sum = self_[i] * x[i];
            for (const auto& [j, value] : row(i))
                sum += static_cast<double>(value) * x[j];
            y[i] = area_[i] > 0 ? sum / area_[i] : Vec3(0.0);
        }
    });
}

} // namespace hemilux
