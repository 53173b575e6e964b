#pragma once
// Sums of many terms, which keep what rounding loses of each. The result is off by about one
// rounding, however many terms there are, and it depends on their order. The method is that of
// Neumaier (1974, "Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen"), with
// the error of an addition as by Knuth.

namespace hemilux {

/// A sum of T: double, or a vector of doubles that is summed by component. Both members are needed
/// to continue it later.
template <class T>
struct CompensatedSum {
    T sum{0.0}, lost{0.0};

    CompensatedSum& operator+=(const T& term) {
        const T next = sum + term;
        const T added = next - sum;
        lost += (sum - (next - added)) + (term - added);
        sum = next;
        return *this;
    }
    [[nodiscard]] T value() const { return sum + lost; }
};

} // namespace hemilux
