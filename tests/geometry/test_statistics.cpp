// The tests' own statistics against values known in closed form or from tables.

#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

TEST_CASE("tails of the distributions") {
    // Chi-square with two degrees of freedom is exponential, with one a squared normal variable.
    for (const double x : {.1, 1.0, 3.0, 10.0, 50.0}) {
        CHECK(chi_square_p_value(x, 2) == Approx(std::exp(-x / 2)).epsilon(1e-12));
        CHECK(chi_square_p_value(x, 1) == Approx(std::erfc(std::sqrt(x / 2))).epsilon(1e-12));
        CHECK(chi_square_p_value(x, 4) == Approx((1 + x / 2) * std::exp(-x / 2)).epsilon(1e-12));
    }
    // Student with one degree of freedom is Cauchy; with two it is algebraic.
    for (const double t : {.01, .5, 1.0, 4.0, 100.0}) {
        CHECK(student_p_value(t, 1) ==
              Approx(1 - 2 / std::numbers::pi * std::atan(t)).epsilon(1e-10));
        CHECK(student_p_value(-t, 2) == Approx(1 - t / std::sqrt(2 + t * t)).epsilon(1e-9));
        CHECK(student_p_value(t, 1e7) == Approx(normal_p_value(t)).epsilon(1e-3).margin(1e-12));
    }
    CHECK(normal_p_value(1.959963984540054) == Approx(.05).epsilon(1e-12));
    CHECK(sidak(1e-3, 1) == Approx(1e-3));
    CHECK(1 - std::pow(1 - sidak(1e-3, 84), 84) == Approx(1e-3).epsilon(1e-9));
}

TEST_CASE("p-values are uniform under the hypothesis") {
    Rng rng(11);
    constexpr std::size_t cells = 13;
    const std::array<double, cells> even = [] {
        std::array<double, cells> e{};
        e.fill(1.0 / cells);
        return e;
    }();
    std::array<std::uint64_t, 10> deciles{}, t_deciles{};
    for (int i = 0; i < 2000; ++i) {
        const auto p = chi_square(1000, even, [&] {
                           return static_cast<std::size_t>(cells * rng.uniform());
                       }).p_value;
        ++deciles[std::min<std::size_t>(9, static_cast<std::size_t>(10 * p))];
        MeanTest mean;
        for (int k = 0; k < 20; ++k)
            mean.add(rng.uniform());
        ++t_deciles[std::min<std::size_t>(9, static_cast<std::size_t>(10 * mean.p_value(.5)))];
    }
    const std::array<double, 10> tenths{.1, .1, .1, .1, .1, .1, .1, .1, .1, .1};
    const double alpha = sidak(significance, 2);
    CHECK(chi_square(deciles, tenths).p_value > alpha);
    CHECK(chi_square(t_deciles, tenths).p_value > alpha);
}

TEST_CASE("small cells are pooled, impossible ones fail") {
    const std::array<double, 4> expected{.499, .499, .001, .001};
    CHECK(chi_square(std::array<std::uint64_t, 4>{500, 500, 0, 0}, expected).degrees == 1);
    CHECK(chi_square(std::array<std::uint64_t, 4>{5000, 5000, 10, 10}, expected).degrees == 3);
    const std::array<double, 3> impossible{.5, .5, 0};
    CHECK(chi_square(std::array<std::uint64_t, 3>{50, 50, 1}, impossible).p_value == 0);
    CHECK(chi_square(10, impossible, [] { return std::size_t{3}; }).p_value == 0);
}
