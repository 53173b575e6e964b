#pragma once
// Sums of many terms that keep what rounding loses of each (Neumaier 1974, "Rundungsfehleranalyse
// einiger Verfahren zur Summation endlicher Summen"; the error of an addition as by Knuth): the
// result is off by about one rounding, however many terms there are. It depends on the order of
// the terms.

namespace hemilux {

/// T: double or a vector of doubles, summed by component. Both members are needed to go on later.
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
