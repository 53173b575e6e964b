// The linear solver against systems with known solutions.
#include "radiosity/engine/linear/gmres.h"

#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <cmath>

using namespace hemilux;

TEST_CASE("A dense non-symmetric system is solved to the tolerance") {
    constexpr std::size_t n = 60;
    Rng rng(5);
    std::vector<double> a(n * n), truth(n), b(n), x(n);
    for (double& v : a)
        v = rng.uniform() / n;
    for (double& v : truth)
        v = rng.uniform();
    const LinearMap multiply = [&](const std::vector<double>& in, std::vector<double>& out) {
        for (std::size_t i = 0; i < n; ++i) {
            out[i] = in[i];
            for (std::size_t j = 0; j < n; ++j)
                out[i] -= a[i * n + j] * in[j];
        }
    };
    multiply(truth, b);
    for (const std::size_t restart : {2u, 5u, 40u}) {
        x.assign(n, 0.0);
        const GmresResult result = gmres(multiply, b, x, {.restart = restart});
        CHECK(result.residual <= 1e-12);
        for (std::size_t i = 0; i < n; ++i)
            CHECK(x[i] == Approx(truth[i]).epsilon(1e-9));
    }
}

TEST_CASE("A very reflective room costs few iterations") {
    // I - rho/n ones: one slow mode, for which plain iteration would need 3e5 rounds.
    constexpr std::size_t n = 100;
    constexpr double rho = .9999;
    const LinearMap multiply = [&](const std::vector<double>& in, std::vector<double>& out) {
        double sum = 0;
        for (const double v : in)
            sum += v;
        for (std::size_t i = 0; i < n; ++i)
            out[i] = in[i] - rho / n * sum;
    };
    const std::vector<double> b(n, 1.0);
    std::vector<double> x(n);
    x[3] = 7; // a bad guess
    const GmresResult result = gmres(multiply, b, x);
    CHECK(result.iterations <= 10);
    for (const double v : x)
        CHECK(v == Approx(1 / (1 - rho)).epsilon(1e-8));
}

TEST_CASE("A row of a hundred rooms is solved with more vectors, and without them it says so") {
    constexpr std::size_t n = 100;
    constexpr double rho = .999999, passed = .01;
    const LinearMap multiply = [](const std::vector<double>& in, std::vector<double>& out) {
        for (std::size_t i = 0; i < n; ++i) {
            const double before = in[i > 0 ? i - 1 : 0], after = in[i + 1 < n ? i + 1 : n - 1];
            out[i] = in[i] - rho * (in[i] + passed * (before - 2 * in[i] + after));
        }
    };
    std::vector<double> b(n), x(n), y(n);
    b[0] = 1;
    const GmresResult result = gmres(multiply, b, x);
    CHECK(result.converged);
    CHECK(result.iterations < 600);
    double sum = 0;
    for (const double v : x)
        sum += v;
    CHECK(sum == Approx(1 / (1 - rho)).epsilon(1e-6)); // of the columns
    x.assign(n, 0.0);
    const GmresResult few = gmres(multiply, b, x, {.max_restart = 40, .max_iterations = 200});
    CHECK_FALSE(few.converged);
    multiply(x, y);
    double squares = 0;
    for (std::size_t i = 0; i < n; ++i)
        squares += (b[i] - y[i]) * (b[i] - y[i]);
    CHECK(few.residual == Approx(std::sqrt(squares)));
}

TEST_CASE("Zero right-hand side, exact guess and singular systems end") {
    const LinearMap identity = [](const std::vector<double>& in, std::vector<double>& out) {
        out = in;
    };
    std::vector<double> x{1, 2};
    CHECK(gmres(identity, {0, 0}, x).residual == 0);
    CHECK(x == std::vector<double>{0, 0});
    x = {3, 4};
    CHECK(gmres(identity, {3, 4}, x).iterations == 0);
    const LinearMap singular = [](const std::vector<double>& in, std::vector<double>& out) {
        out = {in[0] - in[1], in[1] - in[0]};
    };
    x = {0, 0};
    const GmresResult result = gmres(singular, {1, 1}, x, {.max_iterations = 100});
    CHECK(result.residual > .1);
    CHECK_FALSE(result.converged);
    CHECK(std::isfinite(x[0]));
}
