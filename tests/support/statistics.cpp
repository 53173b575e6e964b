#include "support/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace hemilux::test {
namespace {

constexpr double epsilon = 1e-15;
constexpr double tiny = 1e-300;
constexpr int max_terms = 100000;

/// Regularised lower incomplete gamma function P(a, x) by its series, for x < a + 1
/// (Abramowitz and Stegun 6.5.29).
double gamma_series(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < max_terms && term > sum * epsilon; ++n)
        sum += term *= x / (a + n);
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// A continued fraction b0 + a1/(b1 + a2/(b2 + ...)) by Lentz's method; `next(n)` gives {a_n, b_n}.
template <class Next>
double continued_fraction(double b0, Next&& next) {
    double f = b0 == 0 ? tiny : b0, c = f, d = 0;
    for (int n = 1; n < max_terms; ++n) {
        const auto [a, b] = next(n);
        d = b + a * d;
        c = b + a / c;
        d = 1 / (d == 0 ? tiny : d);
        c = c == 0 ? tiny : c;
        f *= c * d;
        if (std::abs(c * d - 1) < epsilon)
            break;
    }
    return f;
}

struct Fraction {
    double a, b;
};

/// Q(a, x) = 1 - P(a, x) for x >= a + 1 (even part of Abramowitz and Stegun 6.5.31).
double gamma_fraction(double a, double x) {
    const double f = continued_fraction(x + 1 - a, [&](int n) {
        return Fraction{-n * (n - a), x + 2 * n + 1 - a};
    });
    return std::exp(a * std::log(x) - x - std::lgamma(a)) / f;
}

/// Regularised incomplete beta function I_x(a, b) for x below its mean (Abramowitz and Stegun
/// 26.5.8).
double beta_fraction(double a, double b, double x) {
    const double f = continued_fraction(1.0, [&](int n) {
        const int m = n / 2;
        const double numerator = n % 2 == 1 ? -(a + m) * (a + b + m) : m * (b - m);
        return Fraction{numerator * x / ((a + n - 1) * (a + n)), 1.0};
    });
    const double front =
        std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x);
    return std::exp(front) / (a * f);
}

} // namespace

double sidak(double total, std::size_t n) {
    return -std::expm1(std::log1p(-total) / static_cast<double>(n));
}

double normal_p_value(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double chi_square_p_value(double x, double degrees) {
    const double a = 0.5 * degrees, half = 0.5 * x;
    if (!(half > 0))
        return 1;
    return half < a + 1 ? 1 - gamma_series(a, half) : gamma_fraction(a, half);
}

double student_p_value(double t, double degrees) {
    const double a = 0.5 * degrees, b = 0.5, x = degrees / (degrees + t * t);
    if (!(t * t > 0))
        return 1;
    if (x < (a + 1) / (a + b + 2))
        return beta_fraction(a, b, x);
    return 1 - beta_fraction(b, a, t * t / (degrees + t * t));
}

ChiSquare chi_square(std::span<const std::uint64_t> counts, std::span<const double> expected) {
    const auto n = static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0ull));
    ChiSquare result;
    std::size_t cells = 0;
    double pooled_count = 0, pooled_expected = 0;
    const auto take = [&](double count, double mean) {
        result.statistic += (count - mean) * (count - mean) / mean;
        ++cells;
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double count = static_cast<double>(counts[i]), mean = n * expected[i];
        if (mean <= 0 && count > 0)
            return {std::numeric_limits<double>::infinity(), 1, 0.0};
        if (mean >= 5) {
            take(count, mean);
        } else {
            pooled_count += count;
            pooled_expected += mean;
        }
    }
    // A rest too small for the test is left out: the statistic can only become smaller.
    if (pooled_expected >= 5)
        take(pooled_count, pooled_expected);
    result.degrees = cells > 0 ? cells - 1 : 0;
    if (result.degrees > 0)
        result.p_value = chi_square_p_value(result.statistic, static_cast<double>(result.degrees));
    return result;
}

ChiSquare chi_square(std::uint64_t samples, std::span<const double> expected,
                     const std::function<std::size_t()>& draw_cell) {
    std::vector<std::uint64_t> counts(expected.size());
    for (std::uint64_t i = 0; i < samples; ++i) {
        const std::size_t cell = draw_cell();
        if (cell >= counts.size())
            return {std::numeric_limits<double>::infinity(), 1, 0.0};
        ++counts[cell];
    }
    return chi_square(counts, expected);
}

void MeanTest::add(double value) {
    ++count_;
    const double change = value - mean_;
    mean_ += change / static_cast<double>(count_);
    squares_ += change * (value - mean_);
}

double MeanTest::standard_error() const {
    const auto n = static_cast<double>(count_);
    return std::sqrt(squares_ / (n * (n - 1)));
}

double MeanTest::p_value(double expected) const {
    const double difference = mean_ - expected, error = standard_error();
    if (!(error > 0))
        return difference == 0 ? 1 : 0;
    return student_p_value(difference / error, static_cast<double>(count_ - 1));
}

} // namespace hemilux::test
