#include "io/drawings/error_curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {

namespace {

bool has_logarithm(double x) { return x > 0 && std::isfinite(x); }

/// Returns y at x on the straight line through two points of log-log paper.
double interpolate(double x0, double y0, double x1, double y1, double x) {
    const double share = std::log(x / x0) / std::log(x1 / x0);
    return y0 * std::pow(y1 / y0, share);
}

double min_error(const ErrorCurve& curve) {
    return std::ranges::min_element(curve, {}, &CurvePoint::error)->error;
}

/// Returns all runs but run i; all of them where there is no such run.
std::vector<ErrorCurve> without(std::span<const ErrorCurve> runs, std::size_t i) {
    std::vector<ErrorCurve> others(runs.begin(), runs.end());
    if (i < others.size())
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    return others;
}

/// Returns `count` numbers from low to high in equal ratios; one where these are the same.
std::vector<double> geometric_series(double low, double high, std::size_t count) {
    std::vector<double> series{low};
    if (!(high > low))
        return series;
    for (std::size_t i = 1; i + 1 < count; ++i)
        series.push_back(low * std::pow(high / low, double(i) / double(count - 1)));
    series.push_back(high);
    return series;
}

} // namespace

void append(ErrorCurve& curve, CurvePoint point) {
    const bool further = curve.empty() || point.x > curve.back().x;
    if (has_logarithm(point.x) && has_logarithm(point.error) && further)
        curve.push_back(point);
}

std::optional<double> error_at(const ErrorCurve& curve, double x) {
    const auto after = std::ranges::lower_bound(curve, x, {}, &CurvePoint::x);
    if (after == curve.end())
        return std::nullopt;
    if (after->x == x)
        return after->error;
    if (after == curve.begin())
        return std::nullopt;
    const CurvePoint& before = *(after - 1);
    return interpolate(before.x, before.error, after->x, after->error, x);
}

MeanCurve mean_curve(std::span<const ErrorCurve> runs, std::size_t count) {
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (const ErrorCurve& run : runs) {
        if (run.empty())
            continue;
        low = std::max(low, run.front().x);
        high = std::min(high, run.back().x);
    }
    MeanCurve result;
    if (!(low > 0 && low <= high))
        return result;
    for (const double x : geometric_series(low, high, count)) {
        std::vector<double> errors;
        for (const ErrorCurve& run : runs)
            if (const std::optional<double> error = error_at(run, x))
                errors.push_back(*error);
        result.x.push_back(x);
        result.mean.push_back(geometric_mean(errors));
        result.low.push_back(*std::ranges::min_element(errors));
        result.high.push_back(*std::ranges::max_element(errors));
    }
    return result;
}

std::optional<double> x_of_error(const ErrorCurve& curve, double error) {
    if (curve.empty() || !(curve.front().error >= error))
        return std::nullopt;
    const auto reached = std::ranges::find_if(
        curve, [error](const CurvePoint& point) { return point.error <= error; });
    if (reached == curve.end())
        return std::nullopt;
    if (reached == curve.begin() || reached->error == error)
        return reached->x;
    const CurvePoint& before = *(reached - 1);
    return interpolate(before.error, before.x, reached->error, reached->x, error);
}

std::optional<double> speed_up(std::span<const ErrorCurve> runs,
                               std::span<const ErrorCurve> base_runs) {
    const auto mean_least = [](std::span<const ErrorCurve> curves) {
        std::vector<double> errors;
        for (const ErrorCurve& curve : curves)
            if (!curve.empty())
                errors.push_back(min_error(curve));
        return geometric_mean(errors);
    };
    // Rounding of logarithms must not put it below the only run that there is.
    constexpr double rounding = 1e-12;
    const double error = std::max(mean_least(runs), mean_least(base_runs)) * (1 + rounding);
    const auto mean_cost = [error](std::span<const ErrorCurve> curves, bool from_first) {
        std::vector<double> costs;
        for (const ErrorCurve& curve : curves) {
            if (from_first && !curve.empty() && curve.front().error < error)
                costs.push_back(curve.front().x);
            else if (const std::optional<double> x = x_of_error(curve, error))
                costs.push_back(*x);
        }
        return geometric_mean(costs);
    };
    const double gain = mean_cost(base_runs, false) / mean_cost(runs, true);
    return std::isfinite(gain) ? std::optional(gain) : std::nullopt;
}

std::optional<double> speed_up_error(std::span<const ErrorCurve> runs,
                                     std::span<const ErrorCurve> base_runs) {
    const std::optional<double> gain = speed_up(runs, base_runs);
    if (!gain || std::min(runs.size(), base_runs.size()) < 2)
        return std::nullopt;
    const std::size_t n = std::max(runs.size(), base_runs.size());
    std::vector<double> logs;
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::optional<double> other = speed_up(without(runs, i), without(base_runs, i));
        if (!other)
            return std::nullopt;
        logs.push_back(std::log(*other));
        mean += logs.back() / double(n);
    }
    double squares = 0;
    for (const double log : logs)
        squares += (log - mean) * (log - mean);
    return *gain * std::sqrt(squares * double(n - 1) / double(n));
}

double geometric_mean(std::span<const double> numbers) {
    double sum = 0;
    std::size_t count = 0;
    for (const double number : numbers) {
        if (!has_logarithm(number))
            continue;
        sum += std::log(number);
        ++count;
    }
    return count > 0 ? std::exp(sum / double(count)) : std::numeric_limits<double>::quiet_NaN();
}

} // namespace hemilux
