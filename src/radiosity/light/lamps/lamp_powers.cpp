#include "radiosity/light/lamps/lamp_powers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// A symmetric matrix that is not negative, row by row, and vectors of its size.
class Normal {
  public:
    explicit Normal(std::size_t n) : n_(n), a_(n * n) {}
    double& at(std::size_t i, std::size_t j) { return a_[i * n_ + j]; }
    [[nodiscard]] double at(std::size_t i, std::size_t j) const { return a_[i * n_ + j]; }

    /// Factors the part of these rows and columns (Cholesky); returns false where it has no
    /// inverse to twelve digits.
    [[nodiscard]] bool factor(const std::vector<std::size_t>& used) {
        constexpr double least = 1e-12;
        used_ = used;
        const std::size_t m = used.size();
        l_.assign(m * m, 0);
        for (std::size_t i = 0; i < m; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = at(used[i], used[j]);
                for (std::size_t k = 0; k < j; ++k)
                    sum -= l_[i * m + k] * l_[j * m + k];
                if (i == j) {
                    if (!(sum > least * at(used[i], used[i])))
                        return false;
                    l_[i * m + i] = std::sqrt(sum);
                } else {
                    l_[i * m + j] = sum / l_[j * m + j];
                }
            }
        return true;
    }
    /// Solves for the part that was factored; elsewhere the result is 0.
    [[nodiscard]] std::vector<double> solve(const std::vector<double>& right) const {
        const std::size_t m = used_.size();
        std::vector<double> y(m), x(n_);
        for (std::size_t i = 0; i < m; ++i) {
            y[i] = right[used_[i]];
            for (std::size_t k = 0; k < i; ++k)
                y[i] -= l_[i * m + k] * y[k];
            y[i] /= l_[i * m + i];
        }
        for (std::size_t i = m; i-- > 0;) {
            for (std::size_t k = i + 1; k < m; ++k)
                y[i] -= l_[k * m + i] * y[k];
            y[i] /= l_[i * m + i];
            x[used_[i]] = y[i];
        }
        return x;
    }

  private:
    std::size_t n_;
    std::vector<double> a_, l_;
    std::vector<std::size_t> used_;
};

/// The lamps that shine, and how the others would change the squares.
class ActiveSets {
  public:
    ActiveSets(const std::vector<WishedPlace>& places, std::size_t lamps)
        : places_(places), normal_(lamps), right_(lamps), factor_(lamps), may_enter_(lamps, true) {
        for (const WishedPlace& place : places)
            for (std::size_t i = 0; i < lamps; ++i) {
                right_[i] += place.brought[i] * place.wish;
                for (std::size_t j = 0; j < lamps; ++j)
                    normal_.at(i, j) += place.brought[i] * place.brought[j];
            }
    }

    LampPowers solve() {
        const std::size_t lamps = factor_.size();
        // Each lamp that enters reduces the sum, so no set comes twice; the limit is for rounding.
        for (std::size_t turn = 0; turn < 10 * lamps + 10; ++turn) {
            const std::size_t next = steepest();
            if (next == lamps)
                break;
            used_.push_back(next);
            if (!normal_.factor(used_)) { // it brings what others bring
                used_.pop_back();
                may_enter_[next] = false;
                continue;
            }
            step_until_feasible();
            std::fill(may_enter_.begin(), may_enter_.end(), true);
        }
        return {factor_, errors()};
    }

  private:
    /// Returns the dark lamp whose light would help most; the number of lamps where none would.
    [[nodiscard]] std::size_t steepest() const {
        const std::size_t lamps = factor_.size();
        std::size_t best = lamps;
        double most = 0;
        for (std::size_t i = 0; i < lamps; ++i) {
            if (!may_enter_[i] || std::find(used_.begin(), used_.end(), i) != used_.end() ||
                !(normal_.at(i, i) > 0))
                continue;
            double gradient = right_[i];
            for (std::size_t j = 0; j < lamps; ++j)
                gradient -= normal_.at(i, j) * factor_[j];
            constexpr double rounding = 1e-12;
            const double gain = gradient / std::sqrt(normal_.at(i, i));
            if (gradient > rounding * std::abs(right_[i]) && gain > most) {
                most = gain;
                best = i;
            }
        }
        return best;
    }

    /// Goes to the solution of the lamps that shine; those that would turn negative become dark.
    void step_until_feasible() {
        while (normal_.factor(used_)) {
            const std::vector<double> goal = normal_.solve(right_);
            double share = 1;
            for (const std::size_t i : used_)
                if (goal[i] <= 0)
                    share = std::min(share, factor_[i] / (factor_[i] - goal[i]));
            for (const std::size_t i : used_)
                factor_[i] += share * (goal[i] - factor_[i]);
            const auto turns_dark = [&](std::size_t i) {
                return goal[i] <= 0 && factor_[i] <= 1e-15 * std::abs(goal[i]);
            };
            if (share == 1 && std::none_of(used_.begin(), used_.end(),
                                           [&](std::size_t i) { return goal[i] <= 0; })) {
                return;
            }
            for (const std::size_t i : used_)
                if (turns_dark(i))
                    factor_[i] = 0;
            std::erase_if(used_, [&](std::size_t i) { return factor_[i] == 0; });
            if (used_.empty())
                return;
        }
    }

    /// With N the inverse of the normal matrix, E_p the light at place p and r_p what is left of
    /// its wish, a change dE_pk changes the factors by (N_k r_p - N E_p f_k) dE_pk.
    [[nodiscard]] std::vector<double> errors() {
        const std::size_t lamps = factor_.size();
        std::vector<double> squares(lamps);
        if (used_.empty() || !normal_.factor(used_))
            return squares;
        std::vector<std::vector<double>> inverse(lamps);
        for (const std::size_t k : used_) {
            std::vector<double> unit(lamps);
            unit[k] = 1;
            inverse[k] = normal_.solve(unit);
        }
        for (const WishedPlace& place : places_) {
            const std::vector<double> response = normal_.solve(place.brought);
            double left = place.wish;
            for (const std::size_t k : used_)
                left -= factor_[k] * place.brought[k];
            for (const std::size_t k : used_)
                for (const std::size_t i : used_) {
                    const double change =
                        place.error[k] * (inverse[k][i] * left - response[i] * factor_[k]);
                    squares[i] += change * change;
                }
        }
        for (double& square : squares)
            square = std::sqrt(square);
        return squares;
    }

    const std::vector<WishedPlace>& places_;
    Normal normal_;
    std::vector<double> right_, factor_;
    std::vector<bool> may_enter_;
    std::vector<std::size_t> used_;
};

} // namespace

LampPowers find_lamp_powers(const std::vector<WishedPlace>& places, std::size_t lamps) {
    return ActiveSets(places, lamps).solve();
}

} // namespace hemilux
