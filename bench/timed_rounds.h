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
[[nodiscard]] inline std::vector<double>
fastest_of_rounds(const std::vector<std::function<void()>>& variants, int rounds) {
    std::vector<double> fastest(variants.size(), std::numeric_limits<double>::infinity());
    for (int r = 0; r < rounds; ++r)
        for (std::size_t e = 0; e < variants.size(); ++e) {
            const double start = cpu_seconds();
            variants[e]();
            fastest[e] = std::min(fastest[e], cpu_seconds() - start);
        }
    return fastest;
}

} // namespace hemilux::bench
