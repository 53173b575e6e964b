#include "io/drawings/log_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hemilux {

namespace {

constexpr double min_ratio = 4;       ///< ratio of the ends of an axis
constexpr double margin_share = 0.04; ///< margin at each end, as a share of the range
constexpr double decades_for_all = 2; ///< longer axes have labels at powers of ten alone
constexpr double max_tick_labels = 7;

} // namespace

LogAxis::LogAxis(const std::vector<double>& numbers) {
    bool any = false;
    for (const double x : numbers) {
        if (!(x > 0) || !std::isfinite(x))
            continue;
        low_ = any ? std::min(low_, x) : x;
        high_ = any ? std::max(high_, x) : x;
        any = true;
    }
    if (high_ < min_ratio * low_) {
        const double widen = std::sqrt(min_ratio * low_ / high_);
        low_ /= widen;
        high_ *= widen;
    }
    const double margin = std::pow(high_ / low_, margin_share);
    low_ /= margin;
    high_ *= margin;
}

double LogAxis::place(double x) const { return std::log(x / low_) / std::log(high_ / low_); }

std::vector<LogTick> LogAxis::ticks() const {
    const int first = static_cast<int>(std::floor(std::log10(low_)));
    const int last = static_cast<int>(std::floor(std::log10(high_)));
    const double decades = std::log10(high_ / low_);
    const int every = std::max(1, static_cast<int>(std::ceil(decades / max_tick_labels)));
    std::vector<LogTick> result;
    for (int decade = first; decade <= last; ++decade)
        for (const int digit : {1, 2, 5}) {
            const double value = digit * std::pow(10.0, decade);
            const bool labelled = digit == 1 ? decade % every == 0 : decades <= decades_for_all;
            if (value >= low_ && value <= high_)
                result.push_back({value, labelled});
        }
    return result;
}

double round_up(double x, double rounding) {
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (x <= digit * decade * rounding)
            return digit * decade;
    return 10 * decade;
}

std::string tick_text(double value) {
    static constexpr std::array<const char*, 5> units{"", "k", "M", "G", "T"};
    std::size_t unit = 0;
    for (; value >= 999.5 && unit + 1 < units.size(); ++unit)
        value /= 1000;
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.3g%s", value, units[unit]);
    return buffer.data();
}

} // namespace hemilux
