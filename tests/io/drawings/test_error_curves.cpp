#include "io/drawings/error_curves.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <cmath>
#include <limits>

using namespace hemilux;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// error = factor x^-1/2 at x = first, 2 first, 4 first, ...
ErrorCurve root_law(double factor, double first, int points) {
    ErrorCurve curve;
    for (double x = first; points-- > 0; x *= 2)
        append(curve, {x, factor / std::sqrt(x)});
    return curve;
}

} // namespace

TEST_CASE("a curve takes what has a logarithm, in ascending order") {
    ErrorCurve curve;
    for (const CurvePoint& point : std::initializer_list<CurvePoint>{
             {0, 1}, {1, unknown}, {1, 0}, {1, -1}, {1, 0.5}, {1, 0.4}, {0.5, 0.4}, {2, 0.3}})
        append(curve, point);
    REQUIRE(curve.size() == 2);
    CHECK(curve[0].error == 0.5);
    CHECK(curve[1].x == 2);
}

TEST_CASE("power laws are straight: interpolation is exact on them") {
    const ErrorCurve curve = root_law(3, 10, 5); // to 160
    for (const double x : {10.0, 11.0, 37.0, 100.0, 160.0})
        CHECK(error_at(curve, x).value() == Approx(3 / std::sqrt(x)));
    CHECK_FALSE(error_at(curve, 9.99));
    CHECK_FALSE(error_at(curve, 160.01));
    CHECK_FALSE(error_at({}, 1));
    for (const double x : {10.0, 25.0, 160.0})
        CHECK(x_of_error(curve, 3 / std::sqrt(x)).value() == Approx(x));
    CHECK_FALSE(x_of_error(curve, 3 / std::sqrt(9.9)));
    CHECK_FALSE(x_of_error(curve, 3 / std::sqrt(161.0)));
    CHECK_FALSE(x_of_error({}, 1));
}

TEST_CASE("the first time that an error is reached counts, whatever comes after") {
    const ErrorCurve curve{{1, 8}, {2, 4}, {4, 6}, {8, 2}};
    CHECK(x_of_error(curve, 4).value() == Approx(2));
    CHECK(x_of_error(curve, 5).value() < 2);
    CHECK(x_of_error(curve, 3).value() > 4);
}

TEST_CASE("the mean of runs is geometric and covers what all of them cover") {
    const std::vector<ErrorCurve> runs{root_law(1, 1, 8), root_law(4, 3, 4), {}};
    const MeanCurve mean = mean_curve(runs, 20);
    REQUIRE(mean.x.size() == 20);
    CHECK(mean.x.front() == 3);
    CHECK(mean.x.back() == 24);
    for (std::size_t i = 0; i < mean.x.size(); ++i) {
        const double root = std::sqrt(mean.x[i]);
        CHECK(mean.low[i] == Approx(1 / root));
        CHECK(mean.mean[i] == Approx(2 / root));
        CHECK(mean.high[i] == Approx(4 / root));
        if (i > 0)
            CHECK(mean.x[i] > mean.x[i - 1]);
    }
}

TEST_CASE("runs with nothing in common have no mean") {
    CHECK(mean_curve(std::vector<ErrorCurve>{}).x.empty());
    CHECK(mean_curve(std::vector<ErrorCurve>{{}, {}}).x.empty());
    CHECK(mean_curve(std::vector<ErrorCurve>{root_law(1, 1, 3), root_law(1, 10, 3)}).x.empty());
    const MeanCurve one = mean_curve(std::vector<ErrorCurve>{{{5, 0.1}}});
    REQUIRE(one.x.size() == 1);
    CHECK(one.mean[0] == Approx(0.1));
}

TEST_CASE("the gain is the ratio of costs at the smallest error that both reach") {
    const auto gain = [](const ErrorCurve& curve, const ErrorCurve& base) {
        return speed_up({&curve, 1}, {&base, 1});
    };
    const ErrorCurve base = root_law(6, 100, 6);
    CHECK(gain(base, base).value() == Approx(1));
    // Half the error at equal cost: a quarter of the cost at equal error.
    CHECK(gain(root_law(3, 100, 6), base).value() == Approx(4));
    CHECK(gain(base, root_law(3, 100, 6)).value() == Approx(0.25));
    // The same law, seen at other places.
    CHECK(gain(root_law(3, 37, 4), base).value() == Approx(4));
    CHECK_FALSE(gain(root_law(1000, 100, 6), base));
    CHECK_FALSE(gain({}, base));
    CHECK_FALSE(gain(base, {}));
    // A method with a floor is judged where its floor is.
    const ErrorCurve floored{{100, 0.6}, {200, 0.5}, {400, 0.4}, {800, 0.4}};
    const std::vector<ErrorCurve> bases{base, base};
    CHECK(speed_up(bases, bases).value() == Approx(1));
    const std::vector<ErrorCurve> fast{root_law(3, 100, 6), root_law(1.5, 100, 6)};
    CHECK(speed_up(fast, bases).value() == Approx(8).epsilon(.2)); // 4 and 16
    CHECK_FALSE(speed_up(std::vector<ErrorCurve>{}, bases));
    CHECK(gain(floored, base).value() == Approx(std::pow(6 / 0.4, 2) / 400));
}

TEST_CASE("the standard error of a gain is that of the difference of logarithms") {
    // Each run is a power law down to the same error, at a cost of (factor / error)^2.
    const auto down_to_error = [](double factor) {
        return ErrorCurve{{1, factor}, {factor * factor / .01, .1}};
    };
    std::vector<ErrorCurve> runs, base;
    std::vector<double> logs;
    double mean = 0;
    for (const auto& [factor, base_factor] :
         {std::pair{3.0, 5.0}, {3.5, 5.2}, {2.8, 4.4}, {3.3, 6.1}}) {
        runs.push_back(down_to_error(factor));
        base.push_back(down_to_error(base_factor));
        logs.push_back(2 * std::log(base_factor / factor));
        mean += logs.back() / 4;
    }
    double squares = 0;
    for (const double log : logs)
        squares += (log - mean) * (log - mean);
    CHECK(speed_up(runs, base).value() == Approx(std::exp(mean)));
    CHECK(speed_up_error(runs, base).value() == Approx(std::exp(mean) * std::sqrt(squares / 12)));
    CHECK(speed_up_error(base, base).value() == Approx(0).margin(1e-12));
    CHECK_FALSE(speed_up_error(std::span(runs).first(1), std::span(base).first(1)));
    CHECK_FALSE(speed_up_error(runs, std::span(base).first(1)));
    CHECK(speed_up_error(std::span(runs).first(2), std::span(base).first(2)).has_value());
    CHECK(speed_up_error(runs, std::span(base).first(2)).has_value());
    CHECK_FALSE(speed_up_error(std::vector<ErrorCurve>{{}, {}}, base));
}

// The same method twice gains nothing. What it seems to gain is noise, which the standard error has
// to cover: over many comparisons the two are as large as each other.
TEST_CASE("the standard error of a gain is as large as the noise of the gain") {
    Rng rng(11);
    const auto noisy_run = [&] { // mean of steps, each of which has an error of its own
        ErrorCurve curve;
        double squares = 0;
        for (int step = 1; step <= 32; ++step) {
            double noise = -2;
            for (int k = 0; k < 4; ++k)
                noise += rng.uniform();
            squares += std::exp(noise);
            append(curve, {100.0 * step, std::sqrt(squares) / step});
        }
        return curve;
    };
    for (const std::size_t count : {3u, 8u}) {
        double gained = 0, reported = 0;
        constexpr int comparisons = 400;
        int known = 0;
        for (int i = 0; i < comparisons; ++i) {
            std::vector<ErrorCurve> runs, base;
            for (std::size_t run = 0; run < count; ++run) {
                runs.push_back(noisy_run());
                base.push_back(noisy_run());
            }
            const std::optional<double> gain = speed_up(runs, base);
            const std::optional<double> error = speed_up_error(runs, base);
            if (!gain || !error)
                continue;
            ++known;
            gained += std::pow(std::log(*gain), 2);
            reported += std::pow(*error / *gain, 2);
        }
        CAPTURE(count, known, gained / known, reported / known);
        CHECK(known > .9 * comparisons);
        CHECK(reported > .6 * gained);
        CHECK(reported < 2.5 * gained);
    }
}

TEST_CASE("the geometric mean leaves out what has no logarithm") {
    CHECK(geometric_mean(std::vector<double>{2, 8}) == Approx(4));
    CHECK(geometric_mean(std::vector<double>{unknown, 3, 0}) == Approx(3));
    CHECK(std::isnan(geometric_mean(std::vector<double>{unknown})));
    CHECK(std::isnan(geometric_mean({})));
}
