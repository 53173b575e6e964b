// The points are nets, uniform, independent between seeds, and integrate smooth functions faster
// than random numbers do.

#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/sobol.h"
#include "support/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// Whether points first, first + 1, ... (2^k of them) put one into each of the 2^k boxes of every
/// dyadic shape in dimensions a and b.
bool is_net(std::uint32_t first, unsigned k, std::uint64_t seed, std::size_t a, std::size_t b) {
    for (unsigned columns = 0; columns <= k; ++columns) {
        std::vector<bool> taken(std::size_t{1} << k);
        for (std::uint32_t i = 0; i < (1u << k); ++i) {
            const auto p = sobol4(first + i, seed);
            const auto x = static_cast<std::size_t>(std::ldexp(p[a], static_cast<int>(columns)));
            const auto y =
                static_cast<std::size_t>(std::ldexp(p[b], static_cast<int>(k - columns)));
            const std::size_t box = (x << (k - columns)) + y;
            if (taken[box])
                return false;
            taken[box] = true;
        }
    }
    return true;
}

/// A smooth function with the mean 1.
double smooth(const std::array<double, 4>& p) {
    double product = 1;
    for (std::size_t d = 0; d < 4; ++d)
        product *= 1 + .5 * std::sin(2 * p[d] + static_cast<double>(d)) -
                   .25 * (std::cos(static_cast<double>(d)) - std::cos(2 + static_cast<double>(d)));
    return product;
}

double estimate(std::uint32_t n, std::uint64_t seed) {
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        sum += smooth(sobol4(i, seed));
    return sum / n;
}

double rms_error(std::uint32_t n, std::uint64_t first_seed) {
    constexpr int seeds = 60;
    double squares = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
        squares += std::pow(estimate(n, first_seed + seed) - 1, 2);
    return std::sqrt(squares / seeds);
}

std::size_t cell(double x, std::size_t cells) {
    return static_cast<std::size_t>(x * static_cast<double>(cells));
}

} // namespace

TEST_CASE("every aligned block of 2^k points is a (0,k,2)-net in dimensions 0 and 1") {
    for (const std::uint64_t seed : {0ull, 1ull, 0x123456789abcdefull})
        for (unsigned k = 0; k <= 10; ++k) {
            CHECK(is_net(0, k, seed, 0, 1));
            CHECK(is_net(3u << k, k, seed, 0, 1));
        }
    CHECK(is_net(0xffffff00u, 8, 7, 0, 1));
}

TEST_CASE("every dimension is stratified") {
    for (unsigned k = 0; k <= 10; ++k)
        for (std::size_t d = 0; d < 4; ++d) {
            std::vector<bool> taken(std::size_t{1} << k);
            for (std::uint32_t i = 0; i < (1u << k); ++i)
                taken[cell(sobol4(i, 5)[d], taken.size())] = true;
            CHECK(std::count(taken.begin(), taken.end(), true) == 1l << k);
        }
}

TEST_CASE("a single point is uniform over the seeds, in every pair of dimensions") {
    constexpr std::size_t cells = 7;
    const std::vector<double> even(cells * cells, 1.0 / (cells * cells));
    const std::vector<std::uint32_t> indices{0, 1, 2, 3, 1000, 0xffffffffu};
    const double alpha = sidak(significance, 6 * indices.size());
    for (const std::uint32_t index : indices)
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b) {
                std::uint64_t seed = 1000 * index;
                CHECK(chi_square(20000, even, [&] {
                          const auto p = sobol4(index, seed++);
                          return cells * cell(p[a], cells) + cell(p[b], cells);
                      }).p_value > alpha);
            }
}

TEST_CASE("coordinates lie strictly between 0 and 1") {
    for (std::uint32_t i = 0; i < 100000; ++i)
        for (const double x : sobol4(i * 42949u, i)) {
            REQUIRE(x > 0);
            REQUIRE(x < 1);
        }
}

TEST_CASE("different seeds are independent") {
    // Pairs (point i of one seed, point i of the next) fill the square evenly.
    constexpr std::size_t cells = 7;
    const std::vector<double> even(cells * cells, 1.0 / (cells * cells));
    const double alpha = sidak(significance, 4 + 1);
    for (std::size_t d = 0; d < 4; ++d) {
        std::uint64_t seed = 0;
        CHECK(chi_square(30000, even, [&] {
                  const auto i = static_cast<std::uint32_t>(seed % 64);
                  const double x = sobol4(i, 2 * seed)[d], y = sobol4(i, 2 * seed + 1)[d];
                  ++seed;
                  return cells * cell(x, cells) + cell(y, cells);
              }).p_value > alpha);
    }
    // So the spread of estimates tells their error: successive estimates are uncorrelated.
    MeanTest product;
    for (std::uint64_t seed = 0; seed < 4000; seed += 2)
        product.add((estimate(16, seed) - 1) * (estimate(16, seed + 1) - 1) * 1e4);
    CHECK(product.p_value(0) > alpha);
}

TEST_CASE("the mean over seeds is unbiased for any number of points") {
    const std::vector<std::uint32_t> counts{1, 3, 16, 37, 64};
    const double alpha = sidak(significance, counts.size());
    for (const std::uint32_t n : counts) {
        MeanTest mean;
        for (std::uint64_t seed = 0; seed < 2000; ++seed)
            mean.add(estimate(n, mix_bits(seed + n)));
        CHECK(mean.p_value(1) > alpha);
    }
}

TEST_CASE("the error of a smooth integral falls faster than n^-1/2") {
    const double coarse = rms_error(16, 100), fine = rms_error(4096, 200);
    const double order = std::log(coarse / fine) / std::log(4096.0 / 16);
    CHECK(order > 1.1);
    // Random points would have an error of about .5 / sqrt(n).
    CHECK(fine < 1e-3);
}
