#include "radiosity/engine/form_factors/exchange_matrix.h"

#include "parallel/gathered_vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace hemilux {
namespace {

/// The number of scalings of a batch's matrix; each takes most of what is missing away. In open
/// scenes no symmetric matrix may agree with all that was lost, and no number would be enough.
constexpr int scalings = 6;
/// The number of scalings of the whole, which start from the mean of the batches' scales.
constexpr int scalings_of_all = 3;

/// One thread reads fewer entries sooner than other threads would be called.
constexpr std::size_t entries_for_one_thread = 60'000;

/// Sums value times x[column], in four sums that do not wait for each other.
double row_sum(std::span<const std::uint32_t> row, const EntryWords& words,
               std::span<const double> x) {
    const auto term = [&, words](std::uint32_t word) {
        return static_cast<double>(words.value(word)) * x[words.column(word)];
    };
    std::array<double, 4> sum{};
    std::size_t next = 0;
    for (; next + 4 <= row.size(); next += 4)
        for (std::size_t k = 0; k < 4; ++k)
            sum[k] += term(row[next + k]);
    for (; next < row.size(); ++next)
        sum[0] += term(row[next]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

} // namespace

ExchangeMatrix::ExchangeMatrix(std::span<const double> area, const RayCounts& batch,
                               const Workers& workers)
    : own_(batch.own_rows()), area_(area), scale_(area_.size(), 1.0), rays_(area_.size()),
      lost_(area_.size()) {
    find_lost(batch);
    store(batch);
    close(scalings, workers);
}

ExchangeMatrix::ExchangeMatrix(std::vector<ExchangeMatrix> batches, const Workers& workers)
    : own_(batches[0].own_), area_(batches[0].area_), scale_(area_.size()), rays_(area_.size()),
      lost_(area_.size()) {
    find_lost(batches);
    for (const ExchangeMatrix& batch : batches)
        for (std::size_t i = 0; i < scale_.size(); ++i)
            scale_[i] += batch.scale_[i] / static_cast<double>(batches.size());
    std::vector<SparseRows> rows;
    for (ExchangeMatrix& batch : batches)
        rows.push_back(std::move(batch.rows_));
    batches.clear();
    rows_ = SparseRows(std::move(rows), workers);
    close(scalings_of_all, workers);
}

void ExchangeMatrix::find_lost(const RayCounts& batch) {
    for (std::uint32_t i = 0; i < lost_.size(); ++i) {
        rays_[i] = batch.rays(i);
        if (rays_[i] > 0)
            lost_[i] = {batch.escaped(i) / rays_[i], batch.absorbed(i) / rays_[i]};
    }
}

void ExchangeMatrix::find_lost(std::span<const ExchangeMatrix> batches) {
    const auto count = static_cast<double>(batches.size());
    for (const ExchangeMatrix& batch : batches)
        for (std::size_t i = 0; i < lost_.size(); ++i) {
            rays_[i] += batch.rays_[i];
            lost_[i].escaped += batch.lost_[i].escaped / count;
            lost_[i].absorbed += batch.lost_[i].absorbed / count;
        }
}

/// The hits of rays from other ranks' patches on this rank's patches, by rank.
struct ExchangeMatrix::HitsOfOthers {
    std::vector<std::vector<std::uint32_t>> hits;  ///< words, patch after patch of that rank
    std::vector<std::vector<std::uint32_t>> sizes; ///< number of words from each such patch
};

/// Exchanges hits among the ranks. For a patch of another rank, `sizes` says how many words go
/// there.
ExchangeMatrix::HitsOfOthers
ExchangeMatrix::hits_of_others(const RayCounts& batch, std::span<const std::uint32_t> sizes) const {
    const unsigned count = own_.ranks().count(), own = own_.ranks().index();
    HitsOfOthers sent{std::vector<std::vector<std::uint32_t>>(count),
                      std::vector<std::vector<std::uint32_t>>(count)};
    if (!own_.ranks().are_several())
        return sent;
    std::vector<std::size_t> all(count);
    for (std::size_t j = 0; j < sizes.size(); ++j)
        all[own_.owner(j)] += sizes[j];
    for (unsigned rank = 0; rank < count; ++rank)
        if (rank != own) {
            sent.hits[rank].reserve(all[rank]);
            sent.sizes[rank].reserve(own_.count());
        }
    std::vector<std::size_t> before(count);
    for (std::size_t k = 0; k < own_.count(); ++k) {
        for (const std::uint32_t word : batch.row(static_cast<std::uint32_t>(own_.item(k))))
            if (const unsigned rank = own_.owner(batch.words().column(word)); rank != own)
                sent.hits[rank].push_back(word);
        for (unsigned rank = 0; rank < count; ++rank)
            if (rank != own) {
                const std::size_t now = sent.hits[rank].size();
                sent.sizes[rank].push_back(
                    static_cast<std::uint32_t>(now - std::exchange(before[rank], now)));
            }
    }
    return {own_.ranks().exchange(sent.hits), own_.ranks().exchange(sent.sizes)};
}

/// Stores the rows. Each begins with what the patch saw; what saw the patch follows.
void ExchangeMatrix::store(const RayCounts& batch) {
    const auto n = static_cast<std::uint32_t>(area_.size());
    const CountWords& words = batch.words();
    std::vector<double> rays_per_area(n);
    std::vector<std::uint32_t> sizes(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        rays_per_area[i] = area_[i] > 0 ? rays_[i] / area_[i] : 0;
        sizes[i] += static_cast<std::uint32_t>(batch.row(i).size());
        for (const std::uint32_t word : batch.row(i))
            ++sizes[words.column(word)];
    }
    const HitsOfOthers others = hits_of_others(batch, sizes);
    for (std::uint32_t i = 0; i < n; ++i)
        if (!own_.owns(i))
            sizes[i] = 0;
    for (const std::vector<std::uint32_t>& of_rank : others.hits)
        for (const std::uint32_t word : of_rank)
            ++sizes[words.column(word)];
    // A patch sees no more of the others than its area.
    const double largest = n > 0 ? *std::ranges::max_element(area_) : 0;
    rows_ = SparseRows(std::move(sizes), static_cast<float>(largest));
    std::vector<std::uint32_t*> next(n); // null: another rank's
    for (std::uint32_t i = 0; i < n; ++i)
        if (own_.owns(i))
            next[i] = rows_.to_write(i) + batch.row(i).size();
    const auto entry_of = [&](std::uint32_t i, std::uint32_t j, std::uint32_t word) {
        return rows_.words().pack(
            i, j, static_cast<float>(words.count(word) / (rays_per_area[i] + rays_per_area[j])));
    };
    std::vector<std::size_t> hits_read(others.hits.size()), sizes_read(others.hits.size());
    for (std::uint32_t i = 0; i < n; ++i) {
        std::uint32_t* seen = rows_.to_write(i);
        for (const std::uint32_t word : batch.row(i)) {
            const std::uint32_t j = words.column(word);
            const std::uint32_t entry = entry_of(i, j, word);
            *seen++ = entry;
            if (next[j])
                *next[j]++ = entry - j + i;
        }
        if (own_.owns(i))
            continue;
        const unsigned owner = own_.owner(i);
        const auto hits_of = std::span(others.hits[owner]).subspan(hits_read[owner]);
        const std::uint32_t size = others.sizes[owner][sizes_read[owner]++];
        hits_read[owner] += size;
        for (const std::uint32_t word : hits_of.first(size)) {
            const std::uint32_t j = words.column(word);
            *next[j]++ = entry_of(j, i, word);
        }
    }
}

Workers ExchangeMatrix::readers(const Workers& workers) const {
    return rows_.entries() < entries_for_one_thread ? Workers(1) : workers;
}

/// Returns what the rows are to sum to [local area]. A value less than 0 means that it is unknown,
/// as the patch itself has not looked.
///
/// Two estimates are combined, each weighted by the inverse of its variance. One is how many of a
/// patch's own rays met no patch. The other is the rays between it and others, those of the others
/// included. In a closed room the first is known to be all. But a ground under an emitter with a
/// narrow shade loses nearly all of its rays. What little is left is known much better from the
/// emitter's side.
std::vector<double> ExchangeMatrix::due(const Workers& workers) const {
    const std::size_t n = area_.size();
    std::vector<double> due(n, -1.0), rays_per_area(n);
    double all = 0, lost = 0;
    for (std::size_t i = 0; i < n; ++i) {
        rays_per_area[i] = area_[i] > 0 ? rays_[i] / area_[i] : 0;
        all += rays_[i];
        lost += rays_[i] * lost_[i].sum();
    }
    for_rows(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!(rays_[i] > 0))
                continue;
            const double kept = std::max(1 - lost_[i].escaped - lost_[i].absorbed, 0.0);
            due[i] = area_[i] * kept;
            if (!(lost > 0))
                continue;
            // The share counts as if one more ray had met what rays meet on average.
            const double share = (rays_[i] * (1 - kept) + lost / all) / (rays_[i] + 1);
            const double variance = area_[i] * area_[i] * share * (1 - share) / rays_[i];
            double sum = 0, variance_of_sum = 0;
            for (const std::uint32_t word : rows_.row(i)) {
                const double value = words().value(word);
                sum += value;
                variance_of_sum += value / (rays_per_area[i] + rays_per_area[words().column(word)]);
            }
            if (variance_of_sum > 0)
                due[i] +=
                    variance / (variance + variance_of_sum) * (std::min(sum, area_[i]) - due[i]);
        }
    });
    return due;
}

/// Rows are closed by c = due / (S r), then by r = due / (S c), and so on (row normalisation;
/// Sinkhorn and Knopp 1967). As S is symmetric, r and c end as multiples of each other, and g is
/// their geometric mean.
void ExchangeMatrix::find_scale(std::span<const double> due, int times, const Workers& workers) {
    const std::size_t n = area_.size();
    std::array<GatheredVector<double>, 2> in_turn{GatheredVector<double>(own_),
                                                  GatheredVector<double>(own_)};
    std::span<const double> before, last = scale_;
    for (int k = 0; k < times; ++k) {
        GatheredVector<double>& after = in_turn[static_cast<std::size_t>(k) % 2];
        for_products(workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const double sum = row_sum(rows_.row(i), words(), last);
                after[i] = 1; // where the patch itself has not looked, what others saw is all
                if (due[i] >= 0)
                    after[i] = sum > 0 ? due[i] / sum : 0;
            }
        });
        after.gather();
        before = std::exchange(last, after);
    }
    for (std::size_t i = 0; i < n; ++i)
        scale_[i] = std::sqrt(last[i] * before[i]);
}

void ExchangeMatrix::close(int times, const Workers& workers) {
    const std::vector<double> due = this->due(workers);
    find_scale(due, times, workers);
    self_.assign(area_.size(), 0.0);
    per_area_.assign(area_.size(), 0.0);
    for_products(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double sum = row_sum(rows_.row(i), words(), scale_);
            if (scale_[i] > 0 && due[i] >= 0)
                self_[i] = (due[i] / scale_[i] - sum) / scale_[i];
            if (area_[i] > 0)
                per_area_[i] = scale_[i] / area_[i];
        }
    });
}

void ExchangeMatrix::multiply(std::span<const Vec3> x, std::span<Vec3> y,
                              const Workers& workers) const {
    std::vector<Lanes> z(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        z[i] = scaled(i, x[i]);
    for_products(workers, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            y[i] = row_times(i, z);
    });
    own_.gather(y);
}

} // namespace hemilux
