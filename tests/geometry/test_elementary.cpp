// The elementary functions: as near to the truth as their header says, right at the ends of their
// domains, and the same bits on every machine.

#include "geometry/elementary.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

using namespace hemilux;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

/// How far a value is from the truth, in units in its last place.
double ulps(double value, long double truth) {
    int exponent = 0;
    std::frexp(static_cast<double>(truth), &exponent);
    const double ulp = std::ldexp(1.0, std::max(exponent - 53, -1074));
    return static_cast<double>(std::abs(static_cast<long double>(value) - truth) / ulp);
}

/// Returns the largest error over arguments between two, or between powers of two with both.
template <class Function, class Truth>
double largest_error(const Function& function, const Truth& truth, double low, double high,
                     bool by_octave = false) {
    Rng random(7);
    double largest = 0;
    for (int k = 0; k < 20000; ++k) {
        const double at = low + (high - low) * random.uniform();
        const double x = by_octave ? std::exp2(at) * (1 + random.uniform()) : at;
        const double error = ulps(function(x), truth(static_cast<long double>(x)));
        largest = error >= 0 ? std::max(largest, error) : infinity;
    }
    return largest;
}

template <class Function, class Truth>
double largest_error_of_two(const Function& function, const Truth& truth, double octaves) {
    Rng random(7);
    double largest = 0;
    for (int k = 0; k < 40000; ++k) {
        const double a = 2 * random.uniform() - 1, b = 2 * random.uniform() - 1;
        const double scale = std::exp2(octaves * random.uniform());
        const double error = ulps(function(a * scale, b), truth(static_cast<long double>(a * scale),
                                                                static_cast<long double>(b)));
        largest = error >= 0 ? std::max(largest, error) : infinity;
    }
    return largest;
}

bool is_same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

TEST_CASE("elementary functions are as near to the truth as stated") {
    if (std::numeric_limits<long double>::digits < 64) {
        WARN("no wider numbers to compare with");
        return;
    }
    using Wide = long double;
    const auto sine = [](Wide x) { return std::sin(x); };
    const auto cosine = [](Wide x) { return std::cos(x); };
    for (const double range : {.8, 7., 1e6}) {
        CAPTURE(range);
        CHECK(largest_error(elementary::sin, sine, -range, range) <= .9);
        CHECK(largest_error(elementary::cos, cosine, -range, range) <= .9);
        const auto x = [](double angle) { return elementary::on_circle(angle).x; };
        const auto y = [](double angle) { return elementary::on_circle(angle).y; };
        CHECK(largest_error(x, cosine, -range, range) <= .9);
        CHECK(largest_error(y, sine, -range, range) <= .9);
        const auto tangent = [](Wide angle) { return std::tan(angle); };
        CHECK(largest_error(elementary::tan, tangent, -range, range) <= 2.2);
    }
    // Near the multiples of pi / 2 almost all of the angle is taken away.
    for (const int k : {1, 2, 3, 4, 1000, 600000}) {
        const auto beside = [&](double x) { return elementary::sin(k * pi / 2 + x); };
        const auto truth = [&](Wide x) {
            return std::sin(static_cast<Wide>(k * pi / 2 + static_cast<double>(x)));
        };
        CHECK(largest_error(beside, truth, -1e-9, 1e-9) <= .9);
    }

    const auto arc = [](Wide x) { return std::atan(x); };
    CHECK(largest_error(elementary::atan, arc, -1.2, 1.2) <= 1.5);
    CHECK(largest_error(elementary::atan, arc, -200, 200, true) <= 1.5);
    const auto angle = [](Wide y, Wide x) { return std::atan2(y, x); };
    for (const double octaves : {0., 5., -5., 700., -700.})
        CHECK(largest_error_of_two(elementary::atan2, angle, octaves) <= 1.5);

    const auto log = [](Wide x) { return std::log(x); };
    const auto log2 = [](Wide x) { return std::log2(x); };
    CHECK(largest_error(elementary::log, log, .5, 2) <= 1);
    CHECK(largest_error(elementary::log, log, -1074, 1022, true) <= 1);
    CHECK(largest_error(elementary::log2, log2, .5, 2) <= 2);
    CHECK(largest_error(elementary::log2, log2, -1074, 1022, true) <= 2);

    const auto exp = [](Wide x) { return std::exp(x); };
    const auto exp2 = [](Wide x) { return std::exp2(x); };
    CHECK(largest_error(elementary::exp, exp, -1, 1) <= 1);
    CHECK(largest_error(elementary::exp, exp, -746, 709.7) <= 1);
    CHECK(largest_error(elementary::exp2, exp2, -1, 1) <= 1.1);
    CHECK(largest_error(elementary::exp2, exp2, -1076, 1023.9) <= 1.1);

    const auto hypot = [](Wide x, Wide y) { return std::hypot(x, y); };
    for (const double octaves : {0., 5., 1000., -1074.})
        CHECK(largest_error_of_two(elementary::hypot, hypot, octaves) <= 1.2);

    for (const double exponent : {.42, 1.6, 2.4, -1.3, -7.}) {
        const auto power = [&](double x) { return elementary::pow(x, exponent); };
        const auto truth = [&](Wide x) { return std::pow(x, static_cast<Wide>(exponent)); };
        const double octaves = 60, bound = 1 + 2 * std::abs(exponent) * (octaves + 1);
        CHECK(largest_error(power, truth, .5, 2) <= 1 + 2 * std::abs(exponent));
        CHECK(largest_error(power, truth, -octaves, octaves, true) <= bound);
    }
    const auto fifth = [](double x) { return elementary::whole_power(x, 5); };
    CHECK(largest_error(
              fifth, [](Wide x) { return x * x * x * x * x; }, -3, 3) <= 5);
}

TEST_CASE("elementary functions are right at the ends of their domains") {
    CHECK(is_same(elementary::sin(0.), 0.));
    CHECK(is_same(elementary::sin(-0.), -0.));
    CHECK(elementary::sin(5e-324) == 5e-324);
    CHECK(elementary::cos(0) == 1);
    for (const double end : {infinity, -infinity, no_number}) {
        CHECK(std::isnan(elementary::sin(end)));
        CHECK(std::isnan(elementary::cos(end)));
        CHECK(std::isnan(elementary::on_circle(end).x));
    }
    for (const double huge : {1e7, 1e15, 1e300, -1e300}) {
        const Vec2 at = elementary::on_circle(huge);
        CHECK(elementary::hypot(at.x, at.y) == Approx(1).epsilon(1e-15));
    }
    CHECK(elementary::sin(1e8) == Approx(std::sin(1e8)).epsilon(1e-7));

    CHECK(is_same(elementary::atan2(0., 1), 0.));
    CHECK(is_same(elementary::atan2(-0., 1), -0.));
    CHECK(is_same(elementary::atan2(0., 0.), 0.));
    CHECK(elementary::atan2(0., -1) == pi);
    CHECK(elementary::atan2(-0., -1) == -pi);
    CHECK(elementary::atan2(0., -0.) == pi);
    CHECK(elementary::atan2(1, 0.) == pi / 2);
    CHECK(elementary::atan2(-1, -0.) == -pi / 2);
    CHECK(elementary::atan2(3, 3) == pi / 4);
    CHECK(elementary::atan2(infinity, infinity) == pi / 4);
    CHECK(elementary::atan2(-infinity, 1) == -pi / 2);
    CHECK(is_same(elementary::atan2(1, infinity), 0.));
    CHECK(elementary::atan2(1, -infinity) == pi);
    CHECK(elementary::atan2(5e-324, 5e-324) == pi / 4);
    CHECK(elementary::atan2(1.7e308, 1.7e308) == pi / 4);
    CHECK(std::isnan(elementary::atan2(no_number, 1)));
    CHECK(std::isnan(elementary::atan2(1, no_number)));
    CHECK(elementary::atan(infinity) == pi / 2);
    CHECK(is_same(elementary::atan(-0.), -0.));

    CHECK(is_same(elementary::log(1), 0.));
    CHECK(elementary::log(0.) == -infinity);
    CHECK(elementary::log(-0.) == -infinity);
    CHECK(elementary::log(infinity) == infinity);
    CHECK(std::isnan(elementary::log(-1)));
    CHECK(std::isnan(elementary::log2(no_number)));
    for (int k = -1074; k < 1024; ++k) {
        CHECK(elementary::log2(std::ldexp(1.0, k)) == k);
        CHECK(elementary::exp2(k) == std::ldexp(1.0, k));
    }

    CHECK(elementary::exp(0) == 1);
    CHECK(elementary::exp(-infinity) == 0);
    CHECK(elementary::exp(infinity) == infinity);
    CHECK(elementary::exp(710) == infinity);
    CHECK(elementary::exp(709.78) < infinity);
    CHECK(elementary::exp(-745) > 0);
    CHECK(elementary::exp(-746) == 0);
    CHECK(elementary::exp2(1024) == infinity);
    CHECK(elementary::exp2(-1e300) == 0);
    CHECK(std::isnan(elementary::exp(no_number)));
    CHECK(std::isnan(elementary::exp2(no_number)));

    CHECK(elementary::pow(0, 2.4) == 0);
    CHECK(elementary::pow(0, -1) == infinity);
    CHECK(elementary::pow(0, 0) == 1);
    CHECK(elementary::pow(infinity, -.5) == 0);
    CHECK(elementary::pow(1, 1e300) == 1);
    CHECK(elementary::pow(4, .5) == 2);
    CHECK(std::isnan(elementary::pow(-1, 2)));
    CHECK(std::isnan(elementary::pow(2, no_number)));
    CHECK(elementary::whole_power(0, 0) == 1);
    CHECK(elementary::whole_power(-2, 3) == -8);
    CHECK(elementary::whole_power(.5, 1074) == 5e-324);

    CHECK(elementary::hypot(3, -4) == 5);
    CHECK(is_same(elementary::hypot(-0., 0.), 0.));
    CHECK(elementary::hypot(3e300, 4e300) == 5e300);
    CHECK(elementary::hypot(0, 5e-324) == 5e-324);
    CHECK(elementary::hypot(no_number, infinity) == infinity);
    CHECK(std::isnan(elementary::hypot(1, no_number)));
}

TEST_CASE("elementary functions have the same bits on every machine") {
    std::uint64_t hash = 0;
    const auto add = [&](double value) {
        hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(value));
    };
    Rng random(1);
    for (int k = 0; k < 50000; ++k) {
        const double x = 20 * random.uniform() - 10, y = 20 * random.uniform() - 10;
        const double positive = elementary::exp(x);
        add(positive);
        add(elementary::sin(x));
        add(elementary::cos(x));
        add(elementary::tan(y));
        add(elementary::atan(x));
        add(elementary::atan2(x, y));
        add(elementary::log(positive));
        add(elementary::log2(positive));
        add(elementary::exp2(x));
        add(elementary::pow(positive, y));
        add(elementary::hypot(x, y));
    }
    CHECK(hash == 0x62e86c0dfae1c837);
}
