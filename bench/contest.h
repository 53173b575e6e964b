#pragma once
// Functions timed in turn, round after round, so that what else happens on the machine meets all of
// them. The fastest round counts: others only ever make a run slower.

#include "clock.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace hemilux::bench {

/// CPU seconds of each.
[[nodiscard]] inline std::vector<double> contest(const std::vector<std::function<void()>>& entrants,
                                                 int rounds) {
    std::vector<double> fastest(entrants.size(), std::numeric_limits<double>::infinity());
    for (int r = 0; r < rounds; ++r)
        for (std::size_t e = 0; e < entrants.size(); ++e) {
            const double start = cpu_seconds();
            entrants[e]();
            fastest[e] = std::min(fastest[e], cpu_seconds() - start);
        }
    return fastest;
}

} // namespace hemilux::bench
