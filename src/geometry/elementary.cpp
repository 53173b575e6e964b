#include "geometry/elementary.h"

#include <array>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

static_assert(FLT_EVAL_METHOD == 0, "a double must be rounded by every operation: -mfpmath=sse");

namespace hemilux::elementary {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Adding this to a number below 2^51 rounds it to a whole number, which stands in the last bits.
constexpr double to_whole = 0x1.8p52;

/// A number of more than 53 bits: the sum of a double and of a small one.
struct Twofold {
    double high, low;
};
constexpr Twofold pi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Twofold ln_2{0x1.62e42fefa3000p-1, 0x1.3de6af278ece6p-42}; // 41 bits, and others

/// Returns a + c x + e x^2 + ... of the coefficients a, b, c, d, e, ...
double every_second(double, double a) { return a; }
double every_second(double, double a, double) { return a; }
template <class... More>
double every_second(double x, double a, double, More... more) {
    return a + x * every_second(x, more...);
}

/// Returns a + b x + c x^2 + ... by Horner's rule, even powers apart from odd ones: a processor
/// computes both at once.
template <class... More>
double polynomial(double x, double a, More... more) {
    const double x2 = x * x;
    return every_second(x2, a, more...) + x * every_second(x2, more...);
}

// ---- sine and cosine -------------------------------------------------------------------------

/// An angle as a number of quarter turns and what is left: at most an eighth of a turn.
struct Reduced {
    Twofold rest;
    unsigned quarters; ///< modulo 4
};

/// Subtracts k pi / 2 in three parts (Cody and Waite 1980). The first two have 33 bits, so that
/// their products with a k below 2^20 are exact, and so is the first difference.
Reduced reduced(double angle) {
    constexpr double half_pi[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
    constexpr double eighth = pi.high / 4, largest = 0x1p20;
    if (std::abs(angle) <= eighth)
        return {{angle, 0}, 0};
    if (!(std::abs(angle) <= largest)) // the remainder is exact, of a period that is rounded
        angle = std::remainder(angle, 2 * pi.high);
    const double shifted = angle * (2 / pi.high) + to_whole;
    const double k = shifted - to_whole;
    const double first = angle - k * half_pi[0];
    const double second = first - k * half_pi[1];
    const double lost = (first - second) - k * half_pi[1] - k * half_pi[2];
    const double rest = second + lost;
    return {{rest, lost - (rest - second)}, unsigned(std::bit_cast<std::uint64_t>(shifted) & 3)};
}

/// sin(x + dx) = sin x + dx cos x
double sine_near_0(const Twofold& angle) {
    const double x = angle.high, x2 = x * x;
    if (x == 0)
        return x; // with its sign
    const double series =
        polynomial(x2, -1. / 6, 1. / 120, -1. / 5040, 1. / 362880, -1. / 39916800, 1. / 6227020800,
                   -1. / 1307674368000, 1. / 355687428096000); // to 17!
    return x + (x * x2 * series + angle.low * (1 - .5 * x2));
}

/// cos(x + dx) = cos x - dx sin x
double cosine_near_0(const Twofold& angle) {
    const double x = angle.high, x2 = x * x;
    const double series =
        polynomial(x2, 1. / 24, -1. / 720, 1. / 40320, -1. / 3628800, 1. / 479001600,
                   -1. / 87178291200, 1. / 20922789888000); // to 16!
    const double half = .5 * x2, so_far = 1 - half, lost = (1 - so_far) - half;
    return so_far + (x2 * x2 * series + (lost - angle.low * x));
}

// ---- arcs ------------------------------------------------------------------------------------

/// A tangent k/4 and its arc. The high parts have 51 bits after the point, as pi has, so that their
/// sums and differences are exact.
struct Arc {
    double from;             ///< the least tangent to which it is near enough
    double halves, quarters; ///< their sum is k/4
    Twofold angle;
};
constexpr std::array<Arc, 5> arcs{{
    {0, 0, 0, {0, 0}},
    {.14, 0, .25, {0x1.f5b75f92c80ep-3, -0x1.4ea9238610a08p-54}},
    {.375, .5, 0, {0x1.dac670561bb5p-2, -0x1.2ea406ee84d0fp-55}},
    {.625, .5, .25, {0x1.4978fa3269eep-1, 0x1.2483350fe548bp-53}},
    {.875, 1, 0, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
}};

/// Returns atan(x) - x for |x| <= .14.
double arc_beyond(double x) {
    const double x2 = x * x;
    return x * x2 *
           polynomial(x2, -1. / 3, 1. / 5, -1. / 7, 1. / 9, -1. / 11, 1. / 13, -1. / 15, 1. / 17);
}

/// Returns atan(small / large) for 0 <= small <= large by
/// atan(s / l) = atan(c) + atan((s - c l) / (l + c s)), with the k/4 next to s / l for c.
Twofold first_eighth(double small, double large) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < arcs.size(); ++k)
        nearest += small >= arcs[k].from * large;
    const auto& [from, halves, quarters, angle] = arcs[nearest];
    const double above = (small - halves * large) - quarters * large; // exact
    const double t = above / (large + (halves + quarters) * small);
    return {angle.high, t + (arc_beyond(t) + angle.low)};
}

Twofold operator-(const Twofold& a, const Twofold& b) { return {a.high - b.high, a.low - b.low}; }

/// Brings a and b, neither below 0, near to 1 if they are not; only their ratio counts.
void scale_both(double& a, double& b) {
    const double larger = a > b ? a : b;
    if (larger == infinity) {
        a = a == infinity ? 1 : 0;
        b = b == infinity ? 1 : 0;
    } else if (larger > 0x1p1000 || larger < 0x1p-900) {
        const double unit = larger > 1 ? 0x1p-1000 : 0x1p1000;
        a *= unit;
        b *= unit;
    }
}

// ---- logarithms and exponentials -------------------------------------------------------------

/// A positive number as fraction 2^exponent, with a fraction from sqrt(1/2) to sqrt(2).
struct Binary {
    double fraction;
    int exponent;
};

Binary binary(double x) {
    Binary result{x, 0};
    result.fraction = std::frexp(x, &result.exponent);
    if (result.fraction < 0x1.6a09e667f3bcdp-1) {
        result.fraction *= 2;
        --result.exponent;
    }
    return result;
}

/// Returns log(1 + z) - z for 1 + z from sqrt(1/2) to sqrt(2). With f = z / (2 + z), the logarithm
/// is 2 atanh f = 2 f + f s, where s = 2 (f^2 / 3 + f^4 / 5 + ...). As 2 f = z - f z, it is z plus
/// what is small and may be rounded.
double log_beyond(double z) {
    const double f = z / (2 + z), f2 = f * f;
    const double s = 2 * f2 *
                     polynomial(f2, 1. / 3, 1. / 5, 1. / 7, 1. / 9, 1. / 11, 1. / 13, 1. / 15,
                                1. / 17, 1. / 19, 1. / 21);
    return f * (s - z);
}

/// Returns what a logarithm is where x has no fraction: x is 0, negative, infinite or no number.
double log_of_end(double x) { return x > 0 ? infinity : x < 0 || x != x ? nan : -infinity; }

bool has_log(double x) { return x > 0 && x < infinity; }

/// Returns e^x 2^k for |x| <= log(2) / 2.
double exp_near_0(double x, double k) {
    const double series = polynomial(x, 1. / 2, 1. / 6, 1. / 24, 1. / 120, 1. / 720, 1. / 5040,
                                     1. / 40320, 1. / 362880, 1. / 3628800, 1. / 39916800,
                                     1. / 479001600, 1. / 6227020800); // to 13!
    return std::ldexp(1 + (x + x * x * series), int(k));
}

} // namespace

double sin(double angle) {
    const Reduced a = reduced(angle);
    const double size = a.quarters % 2 == 0 ? sine_near_0(a.rest) : cosine_near_0(a.rest);
    return a.quarters < 2 ? size : -size;
}

double cos(double angle) {
    const Reduced a = reduced(angle);
    const double size = a.quarters % 2 == 0 ? cosine_near_0(a.rest) : sine_near_0(a.rest);
    return a.quarters == 0 || a.quarters == 3 ? size : -size;
}

Vec2 on_circle(double angle) {
    const Reduced a = reduced(angle);
    const double s = sine_near_0(a.rest), c = cosine_near_0(a.rest);
    const Vec2 turned = a.quarters % 2 == 0 ? Vec2(c, s) : Vec2(-s, c);
    return a.quarters < 2 ? turned : -turned;
}

double tan(double angle) {
    const Vec2 point = on_circle(angle);
    return point.y / point.x;
}

double atan2(double y, double x) {
    if (x != x || y != y)
        return nan;
    double height = std::abs(y), width = std::abs(x);
    scale_both(height, width);
    Twofold angle{0, 0};
    if (height > width)
        angle = Twofold{pi.high / 2, pi.low / 2} - first_eighth(width, height);
    else if (height > 0)
        angle = first_eighth(height, width);
    if (std::signbit(x))
        angle = pi - angle;
    return std::copysign(angle.high + angle.low, y);
}

double atan(double tangent) { return atan2(tangent, 1); }

double log(double x) {
    if (!has_log(x))
        return log_of_end(x);
    const auto [fraction, exponent] = binary(x);
    const double z = fraction - 1, k = exponent;
    return k * ln_2.high + (z + (log_beyond(z) + k * ln_2.low));
}

double log2(double x) {
    if (!has_log(x))
        return log_of_end(x);
    const auto [fraction, exponent] = binary(x);
    const double z = fraction - 1;
    return exponent + (z + log_beyond(z)) * (1 / (ln_2.high + ln_2.low));
}

double exp(double x) {
    constexpr double largest = 710, smallest = -746;
    if (!(x > smallest && x < largest))
        return x > 0 ? infinity : x < 0 ? 0 : nan;
    const double k = (x * (1 / (ln_2.high + ln_2.low)) + to_whole) - to_whole;
    return exp_near_0((x - k * ln_2.high) - k * ln_2.low, k);
}

double exp2(double x) {
    constexpr double largest = 1024, smallest = -1076;
    if (!(x > smallest && x < largest))
        return x > 0 ? infinity : x < 0 ? 0 : nan;
    const double k = (x + to_whole) - to_whole;
    return exp_near_0((x - k) * (ln_2.high + ln_2.low), k);
}

double pow(double x, double y) { return y == 0 ? 1 : exp2(y * log2(x)); }

double whole_power(double x, unsigned n) {
    double result = 1;
    for (; n > 0; n /= 2, x *= x)
        if (n % 2 == 1)
            result *= x;
    return result;
}

double hypot(double a, double b) {
    a = std::abs(a);
    b = std::abs(b);
    if (a == infinity || b == infinity)
        return infinity;
    const double larger = a > b ? a : b;
    const double unit = larger > 0x1p500 ? 0x1p-600 : larger < 0x1p-400 ? 0x1p600 : 1;
    a *= unit;
    b *= unit;
    return std::sqrt(a * a + b * b) / unit;
}

} // namespace hemilux::elementary
