#pragma once
// Gauss-Legendre rules over [0,1].

#include <vector>

namespace hemilux::test {

struct GaussPoint {
    double at, weight;
};

/// The rule of n points, exact for polynomials of degree 2n - 1; its weights have the sum 1.
[[nodiscard]] const std::vector<GaussPoint>& gauss_rule(int n);

} // namespace hemilux::test
