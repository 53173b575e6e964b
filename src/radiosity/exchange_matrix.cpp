#include "radiosity/exchange_matrix.h"

#include "radiosity/mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux {
namespace {

constexpr std::size_t rows_per_chunk = 64;

/// Scaling goes on until all rows are closed to this, or so often.
constexpr double closed = 1e-9;
constexpr int most_scalings = 60;

/// Fewer entries are read sooner than other threads would be started.
constexpr std::size_t entries_for_one_thread = 400'000;

} // namespace

ExchangeMatrix::ExchangeMatrix(const Mesh& mesh, std::span<const RayCounts> sets,
                               const Workers& workers)
    : lost_(mesh.patches().size()) {
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
        area_.push_back(mesh.patches()[i].area);
        rays_.push_back(rays);
        rays_per_area_.push_back(area_[i] > 0 ? rays / area_[i] : 0);
    }
    merge(sets);
    close(workers);
}

/// Rows are visited in order, so what they put into other rows arrives there in order too.
void ExchangeMatrix::merge(std::span<const RayCounts> sets) {
    const std::size_t n = area_.size();
    std::vector<std::size_t> places(n + 1);
    for (const RayCounts& set : sets)
        for (std::uint32_t i = 0; i < n; ++i)
            for (const RayCounts::Count& count : set.row(i)) {
                ++places[i + 1];
                ++places[count.patch + 1];
            }
    for (std::size_t i = 0; i < n; ++i)
        places[i + 1] += places[i];
    std::vector<RayCounts::Count> all(places[n]);
    std::vector<std::size_t> next(places.begin(), places.end() - 1);
    for (const RayCounts& set : sets)
        for (std::uint32_t i = 0; i < n; ++i)
            for (const auto& [j, hits] : set.row(i)) {
                all[next[i]++] = {j, hits};
                all[next[j]++] = {i, hits};
            }
    row_begin_.assign(1, 0);
    column_.reserve(all.size());
    value_.reserve(all.size());
    for (std::size_t i = 0; i < n; ++i) {
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(places[i]);
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(places[i + 1]);
        std::sort(begin, end, [](const auto& a, const auto& b) { return a.patch < b.patch; });
        for (auto count = begin; count != end;) {
            const std::uint32_t j = count->patch;
            double hits = 0;
            for (; count != end && count->patch == j; ++count)
                hits += count->hits;
            column_.push_back(j);
            value_.push_back(static_cast<float>(hits / (rays_per_area_[i] + rays_per_area_[j])));
        }
        row_begin_.push_back(column_.size());
    }
    column_.shrink_to_fit();
    value_.shrink_to_fit();
}

/// Rows are closed by c = due / (S r), then by r = due / (S c), and so on (Sinkhorn and Knopp
/// 1967). As S is symmetric, r and c end as multiples of each other, and g is their geometric mean.
void ExchangeMatrix::close(const Workers& workers) {
    const std::size_t n = area_.size();
    const Workers readers = column_.size() < entries_for_one_thread ? Workers(1) : workers;
    scale_.assign(n, 1.0);
    std::vector<double> before(n, 1.0), after(n), off(n);
    for (int k = 0; k < most_scalings; ++k) {
        readers.for_chunks(n, rows_per_chunk, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                double sum = 0;
                for (std::size_t e = row_begin_[i]; e < row_begin_[i + 1]; ++e)
                    sum += static_cast<double>(value_[e]) * scale_[column_[e]];
                const double share = 1 - lost_[i].escaped - lost_[i].absorbed;
                after[i] = 1; // where the patch itself has not looked, what others saw is all
                if (rays_per_area_[i] > 0)
                    after[i] = sum > 0 ? std::max(share, 0.0) * area_[i] / sum : 0;
                off[i] = after[i] > 0 ? std::abs(before[i] / after[i] - 1) : 0;
            }
        });
        before = std::exchange(scale_, after);
        if (*std::ranges::max_element(off) < closed)
            break;
    }
    for (std::size_t i = 0; i < n; ++i)
        scale_[i] = std::sqrt(scale_[i] * before[i]);
}

void ExchangeMatrix::multiply(std::span<const Vec3> x, std::span<Vec3> y,
                              const Workers& workers) const {
    const Workers readers = column_.size() < entries_for_one_thread ? Workers(1) : workers;
    readers.for_chunks(y.size(), rows_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Vec3 sum(0.0);
            for (std::size_t e = row_begin_[i]; e < row_begin_[i + 1]; ++e) {
                const std::uint32_t j = column_[e];
                sum += static_cast<double>(value_[e]) * scale_[j] * x[j];
            }
            y[i] = area_[i] > 0 ? scale_[i] / area_[i] * sum : Vec3(0.0);
        }
    });
}

} // namespace hemilux
