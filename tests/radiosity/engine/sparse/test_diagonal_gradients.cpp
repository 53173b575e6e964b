// Conjugate gradients that end where they should, and say so where they end at their limit.
#include "radiosity/engine/sparse/diagonal_gradients.h"
#include "support/catch.h"

using namespace hemilux;

namespace {

constexpr std::size_t rows = 30;

/// A chain of springs, whose slowest mode takes as many iterations as it has rows.
void multiply(std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < rows; ++i)
        y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < rows ? x[i + 1] : 0);
}

GradientsEnd solve(int iterations, std::vector<double>& x) {
    const std::vector<double> diagonal(rows, 2.0);
    std::vector<double> right(rows);
    right[0] = 1;
    x.assign(rows, 0.0);
    return add_solution(diagonal, right, {.square = 1e-24, .iterations = iterations}, multiply, x);
}

} // namespace

TEST_CASE("Gradients solve a chain within its length and say that they did") {
    std::vector<double> x;
    const GradientsEnd end = solve(2 * rows, x);
    CHECK(end.converged);
    CHECK(end.residual <= 1e-12);
    CHECK(end.iterations <= int(rows));
    for (std::size_t i = 0; i < rows; ++i)
        CHECK(x[i] == Approx(double(rows - i) / (rows + 1)).epsilon(1e-9));
}

TEST_CASE("Gradients that end at their limit say so, with the residual that is left") {
    std::vector<double> x;
    const GradientsEnd end = solve(rows / 2, x);
    CHECK_FALSE(end.converged);
    CHECK(end.iterations == int(rows) / 2);
    std::vector<double> y(rows);
    multiply(x, y);
    double squares = 0;
    for (std::size_t i = 0; i < rows; ++i)
        squares += ((i == 0 ? 1 : 0) - y[i]) * ((i == 0 ? 1 : 0) - y[i]);
    CHECK(end.residual == Approx(std::sqrt(squares)).epsilon(1e-9));
    CHECK(end.residual > 1e-3);
}
