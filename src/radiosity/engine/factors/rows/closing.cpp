#include "radiosity/engine/factors/rows/closing.h"

#include "geometry/elementary.h"
#include "radiosity/engine/sparse/diagonal_gradients.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace hemilux {
namespace {

/// The error of exact factors, as a share of the smaller area.
constexpr double exact_error = 1e-10;

/// Rows are closed when they lack less than this [-].
constexpr double closed = 2e-15;

constexpr int max_rounds = 40;
/// Row sums that are off by no more are solved also where the iterations see only rounding errors
/// [-].
constexpr double rounding_of_sums = 1e-12;

/// The system of the rows' multipliers.
class Rows {
  public:
    explicit Rows(ExchangeList& list, std::uint32_t rays)
        : list_(list), lacking_(list.area.size()) {
        variance_.resize(list.pairs.size());
        for (std::uint32_t i = 0; i < list.pairs.size(); ++i) {
            variance_[i].reserve(list.pairs[i].size());
            for (const PairExchange& pair : list.pairs[i]) {
                const double least = exact_error * std::min(list.area[i], list.area[pair.to]);
                const bool is_unfound = list.has_all_pairs && !(pair.exchange > 0);
                const double deviation = is_unfound ? 0 : std::max(double(pair.deviation), least);
                variance_[i].push_back(deviation * deviation);
            }
        }
        for (std::size_t i = 0; i < list.area.size(); ++i)
            for (const OpenShare& open : list.open[i]) {
                const double deviation = open.factor > 0 ? open.standard_error * list.area[i] : 0;
                open_variance_.push_back(deviation * deviation);
            }
        find_lacking();
        find_diagonal();
        free_unfound(rays);
    }

    void audit_before(ClosingAudit& audit) const;
    /// Returns false where the iterations ended at their limit.
    [[nodiscard]] bool solve_and_move(int max_iterations);
    /// Sets what is negative to 0 for good; returns how many.
    std::uint64_t set_negative_to_zero();
    [[nodiscard]] double worst_lacking() const;
    void update() {
        find_lacking();
        find_diagonal();
    }
    [[nodiscard]] double variance(std::size_t i, std::size_t k) const { return variance_[i][k]; }
    [[nodiscard]] double open_variance(std::size_t i, std::size_t k) const {
        return open_variance_[i * opens + k];
    }
    [[nodiscard]] double diagonal(std::size_t i) const { return diagonal_[i]; }
    [[nodiscard]] double lacking(std::size_t i) const { return lacking_[i]; }

  private:
    void find_lacking();
    void find_diagonal();
    void free_unfound(std::uint32_t rays);
    void multiply(std::span<const double> x, std::span<double> y) const;

    ExchangeList& list_;
    std::vector<std::vector<double>> variance_;
    std::vector<double> open_variance_;
    std::vector<double> lacking_, diagonal_; ///< of exchange, by row
};

void Rows::find_lacking() {
    // Rows are summed with compensation, as their sums are asked for to the last digits.
    const std::size_t rows = list_.area.size();
    std::vector<double> rest(rows);
    lacking_ = list_.area;
    const auto subtract = [&](std::size_t i, double value) {
        const double sum = lacking_[i] - value;
        rest[i] += (lacking_[i] - sum) - value;
        lacking_[i] = sum;
    };
    for (std::size_t i = 0; i < rows; ++i) {
        for (const OpenShare& open : list_.open[i])
            subtract(i, open.factor * list_.area[i]);
        for (const PairExchange& pair : list_.pairs[i]) {
            subtract(i, pair.exchange);
            subtract(pair.to, pair.exchange);
        }
    }
    for (std::size_t i = 0; i < rows; ++i)
        lacking_[i] += rest[i];
}

void Rows::find_diagonal() {
    diagonal_.assign(list_.area.size(), 0);
    for (std::size_t i = 0; i < list_.area.size(); ++i) {
        for (std::size_t k = 0; k < opens; ++k)
            diagonal_[i] += open_variance_[i * opens + k];
        for (std::size_t k = 0; k < list_.pairs[i].size(); ++k) {
            diagonal_[i] += variance_[i][k];
            diagonal_[list_.pairs[i][k].to] += variance_[i][k];
        }
    }
}

/// What no ray found stays 0, unless its row lacks more than chance explains. Then openings may
/// have what half a ray stands for; where all pairs are listed, those that are 0 may be more, and
/// openings that no ray of any row found are left for rows without such pairs.
void Rows::free_unfound(std::uint32_t rays) {
    constexpr double beyond_chance = 4;
    const std::size_t rows = list_.area.size();
    std::vector<bool> lacks(rows), has_unfound(rows);
    std::array<bool, 2> is_found{}; // sky and ground
    for (std::size_t i = 0; i < rows; ++i) {
        lacks[i] = lacking_[i] > beyond_chance * std::sqrt(diagonal_[i]);
        for (std::size_t k = 0; k < is_found.size(); ++k)
            is_found[k] = is_found[k] || list_.open[i][k].factor > 0;
    }
    for (std::size_t i = 0; i < rows && list_.has_all_pairs; ++i)
        for (std::size_t k = 0; k < list_.pairs[i].size(); ++k) {
            const PairExchange& pair = list_.pairs[i][k];
            if (pair.exchange > 0 || !(lacks[i] || lacks[pair.to]))
                continue;
            variance_[i][k] = double(pair.deviation) * double(pair.deviation);
            has_unfound[i] = has_unfound[pair.to] = true;
        }
    for (std::size_t i = 0; i < rows; ++i) {
        const double deviation = .5 * list_.area[i] / rays;
        for (std::size_t k = 0; k < is_found.size(); ++k)
            if (lacks[i] && (is_found[k] || !has_unfound[i]) && !(list_.open[i][k].factor > 0))
                open_variance_[i * opens + k] = deviation * deviation;
    }
    find_diagonal();
}

void Rows::multiply(std::span<const double> x, std::span<double> y) const {
    for (std::size_t i = 0; i < x.size(); ++i)
        y[i] = diagonal_[i] * x[i];
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t k = 0; k < list_.pairs[i].size(); ++k) {
            const std::uint32_t j = list_.pairs[i][k].to;
            y[i] += variance_[i][k] * x[j];
            y[j] += variance_[i][k] * x[i];
        }
}

void Rows::audit_before(ClosingAudit& audit) const {
    const std::size_t rows = lacking_.size();
    double squares = 0, chances = 0;
    for (std::uint32_t i = 0; i < rows; ++i) {
        const double lacking = std::abs(lacking_[i]) / list_.area[i];
        const double deviation = std::sqrt(diagonal_[i]) / list_.area[i];
        const double chance = lacking / std::max(deviation, 1e-10);
        squares += lacking * lacking;
        chances += chance * chance;
        if (lacking > audit.lacking_worst) {
            audit.lacking_worst = lacking;
            audit.worst_row = i;
        }
        audit.chance_worst = std::max(audit.chance_worst, chance);
        audit.rows_beyond_chance += chance > 5 && lacking > 1e-8;
    }
    audit.lacking_rms = std::sqrt(squares / static_cast<double>(rows));
    audit.chance_rms = std::sqrt(chances / static_cast<double>(rows));
}

bool Rows::solve_and_move(int max_iterations) {
    const std::size_t rows = lacking_.size();
    std::vector<double> multiplier(rows);
    const GradientsEnd end = add_solution(
        diagonal_, lacking_, {.square = 1e-28, .iterations = max_iterations},
        [this](std::span<const double> x, std::span<double> y) { multiply(x, y); }, multiplier);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t k = 0; k < opens; ++k)
            list_.open[i][k].factor +=
                open_variance_[i * opens + k] * multiplier[i] / list_.area[i];
        for (std::size_t k = 0; k < list_.pairs[i].size(); ++k) {
            PairExchange& pair = list_.pairs[i][k];
            pair.exchange += variance_[i][k] * (multiplier[i] + multiplier[pair.to]);
        }
    }
    return end.converged;
}

std::uint64_t Rows::set_negative_to_zero() {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < list_.area.size(); ++i) {
        for (std::size_t k = 0; k < opens; ++k)
            if (list_.open[i][k].factor < 0) {
                list_.open[i][k].factor = 0;
                open_variance_[i * opens + k] = 0;
                ++count;
            }
        for (std::size_t k = 0; k < list_.pairs[i].size(); ++k)
            if (list_.pairs[i][k].exchange < 0) {
                list_.pairs[i][k].exchange = 0;
                variance_[i][k] = 0;
                ++count;
            }
    }
    return count;
}

double Rows::worst_lacking() const {
    double worst = 0;
    for (std::size_t i = 0; i < lacking_.size(); ++i)
        if (diagonal_[i] > 0)
            worst = std::max(worst, std::abs(lacking_[i]) / list_.area[i]);
    return worst;
}

std::vector<std::vector<double>> exchanges_of(const ExchangeList& list) {
    std::vector<std::vector<double>> exchanges(list.pairs.size());
    for (std::size_t i = 0; i < list.pairs.size(); ++i) {
        exchanges[i].reserve(list.pairs[i].size());
        for (const PairExchange& pair : list.pairs[i])
            exchanges[i].push_back(pair.exchange);
    }
    return exchanges;
}

} // namespace

ClosingAudit close_rows(ExchangeList& list, std::uint32_t rays_of_row, int max_iterations) {
    ClosingAudit audit;
    const std::vector<std::array<OpenShare, opens>> open_before = list.open;
    const std::vector<std::vector<double>> exchange_before = exchanges_of(list);
    Rows rows(list, rays_of_row);
    rows.audit_before(audit);
    std::vector<double> first_diagonal(list.area.size());
    for (std::size_t i = 0; i < list.area.size(); ++i)
        first_diagonal[i] = rows.diagonal(i);
    double last = 1;
    bool is_solved = true;
    for (int round = 0; round < max_rounds; ++round) {
        is_solved = rows.solve_and_move(max_iterations);
        const std::uint64_t negative = rows.set_negative_to_zero();
        audit.set_to_zero += negative;
        rows.update();
        const double worst = rows.worst_lacking();
        if (negative == 0 && (worst <= closed || worst > .5 * last))
            break;
        last = negative == 0 ? worst : 1;
    }
    audit.left_worst = rows.worst_lacking();
    if (!is_solved && audit.left_worst > rounding_of_sums)
        audit.unsolved = audit.left_worst;
    const auto unsolved_of = [&](std::size_t i) {
        return audit.unsolved > 0 ? std::abs(rows.lacking(i)) : 0;
    };
    // The rest of a row says of one pair in it what is left of the row's sum, with the variance of
    // the rest. What is not listed is a part of that.
    const auto rest_of = [&](std::size_t i, double variance) {
        const double unlisted = list.unlisted[i] * list.area[i];
        return std::max(first_diagonal[i] - variance, 0.0) + unlisted * unlisted;
    };
    // The variance after a change that makes use of a row's sum is smaller by about the part that
    // the row's own uncertainty has in it.
    const auto remaining = [](double variance, double parts) {
        return std::sqrt(variance * std::max(1 - parts, 0.0));
    };
    for (std::size_t i = 0; i < list.area.size(); ++i) {
        const double own = first_diagonal[i];
        double unfound = 0;
        const auto prior = [&](std::size_t k) {
            const double deviation = open_before[i][k].standard_error * list.area[i];
            return deviation * deviation;
        };
        for (std::size_t k = 0; k < opens; ++k)
            unfound += open_before[i][k].factor > 0 ? 0 : prior(k);
        for (std::size_t k = 0; k < opens; ++k) {
            // An opening that no ray found cannot be larger than the rest of the row is uncertain.
            const double variance = prior(k);
            const double all = own + (open_before[i][k].factor > 0 ? unfound : variance);
            // What is not listed went to where the row is least certain.
            if (variance > 0)
                list.open[i][k].standard_error =
                    elementary::hypot(remaining(variance, variance / all) / list.area[i],
                                      variance / all * list.unlisted[i]) +
                    unsolved_of(i) / list.area[i];
        }
        for (std::size_t k = 0; k < list.pairs[i].size(); ++k) {
            PairExchange& pair = list.pairs[i][k];
            const double old = exchange_before[i][k], moved = std::abs(pair.exchange - old);
            const double smaller = std::min(list.area[i], list.area[pair.to]);
            if (!(pair.deviation > 0)) {
                audit.largest_exact_move = std::max(audit.largest_exact_move, moved / smaller);
                continue;
            }
            const double variance = double(pair.deviation) * double(pair.deviation);
            audit.largest_move = std::max(audit.largest_move, moved / double(pair.deviation));
            const double left = std::sqrt(
                1 / (1 / variance + 1 / rest_of(i, variance) + 1 / rest_of(pair.to, variance)));
            pair.deviation =
                static_cast<float>(left + std::max(unsolved_of(i), unsolved_of(pair.to)));
        }
    }
    return audit;
}

} // namespace hemilux
