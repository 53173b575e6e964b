#pragma once
// Functions timed in turn, round after round, so that what else happens on the machine meets all of
// them; the median counts.

#include "clock.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace hemilux::bench {

/// CPU seconds of each.
[[nodiscard]] inline std::vector<double> contest(const std::vector<std::function<void()>>& entrants,
                                                 int rounds) {
    std::vector<std::vector<double>> seconds(entrants.size());
    for (int r = 0; r <= rounds; ++r)
        for (std::size_t e = 0; e < entrants.size(); ++e) {
            const double start = cpu_seconds();
            entrants[e]();
            if (r > 0) // the first round warms up
                seconds[e].push_back(cpu_seconds() - start);
        }
    std::vector<double> medians;
    for (std::vector<double>& s : seconds) {
        std::nth_element(s.begin(), s.begin() + std::ptrdiff_t(s.size() / 2), s.end());
        medians.push_back(s[s.size() / 2]);
    }
    return medians;
}

} // namespace hemilux::bench
