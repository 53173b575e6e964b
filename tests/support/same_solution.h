#pragma once
// Two solutions whose estimates are the same to the last bit.

#include "support/catch.h"
#include "support/solve.h"

namespace hemilux::test {

/// All but their energy, whose sums may be taken in another order.
inline void check_same_estimates(const Solution& a, const Solution& b) {
    CHECK(same_bits(a.radiosity, b.radiosity));
    CHECK(same_bits(a.standard_error, b.standard_error));
    CHECK(a.hits == b.hits);
    CHECK(a.steps == b.steps);
    CHECK(a.rays_energy == b.rays_energy);
    CHECK(a.rays_density == b.rays_density);
    CHECK(a.variance == b.variance);
}

} // namespace hemilux::test
