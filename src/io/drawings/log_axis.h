#pragma once
// A logarithmic axis: its range, and the numbers 1, 2 and 5 times a power of ten on it.

#include <string>
#include <vector>

namespace hemilux {

struct LogTick {
    double value;
    bool labelled;
};

class LogAxis {
  public:
    /// Makes an axis that is wide enough for all numbers that are positive and finite, with some
    /// room at both ends. It is no narrower than a factor of four.
    explicit LogAxis(const std::vector<double>& numbers);

    [[nodiscard]] double low() const { return low_; }
    [[nodiscard]] double high() const { return high_; }
    /// Returns the place of a number on the axis: 0 at the low end, 1 at the high one.
    [[nodiscard]] double place(double x) const;
    /// Returns the ticks in ascending order. On a long axis only the powers of ten have labels, or
    /// only some.
    [[nodiscard]] std::vector<LogTick> ticks() const;

  private:
    double low_ = 1, high_ = 10;
};

/// Returns the smallest 1, 2 or 5 times a power of ten that, times `rounding`, is not below x,
/// which is above 0.
[[nodiscard]] double round_up(double x, double rounding = 1);

/// Returns a label such as 0.05, 20, 500, 2k, 10M or 1e-07.
[[nodiscard]] std::string tick_text(double value);

} // namespace hemilux
