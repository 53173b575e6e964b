#pragma once
// The elementary functions, with the same bytes on every machine.
//
// C libraries round the last bit of a sine or a logarithm in different ways, and one library may do
// so differently from processor to processor. The functions here are made of what IEEE 754 rounds
// in one way: + - * / and the square root. So all results of hemilux depend on nothing else.
//
// Each function brings its argument into a small interval by an identity. There it sums the Taylor
// series up to a term that is below half of the last bit (Muller 2016, "Elementary Functions"). The
// stated errors, in units in the last place (ulp), are a little more than the largest of four
// million arguments each against long double. Zeros and infinities give what they do in C. A NaN
// gives a NaN, and so does an argument outside the domain.

#include "geometry/vector.h"

namespace hemilux::elementary {

/// Sine and cosine of an angle [rad], within 0.9 ulp for |angle| <= 1e6. Beyond, they are those of
/// an angle within half an ulp of the one given.
[[nodiscard]] double sin(double angle);
[[nodiscard]] double cos(double angle);
/// Returns cosine and sine at once: the point of the unit circle at an angle [rad].
[[nodiscard]] Vec2 on_circle(double angle);
/// Tangent of an angle [rad], within 2.2 ulp for |angle| <= 1e6.
[[nodiscard]] double tan(double angle);

/// Returns the angle [rad] from -pi to pi of the vector (x, y), within 1.5 ulp. Zeros have the
/// angles of the signs that they carry.
[[nodiscard]] double atan2(double y, double x);
/// Returns the angle [rad] from -pi/2 to pi/2 with this tangent, within 1.5 ulp.
[[nodiscard]] double atan(double tangent);

/// Natural logarithm, within 1 ulp.
[[nodiscard]] double log(double x);
/// Logarithm to base 2, within 2 ulp; exact for powers of two.
[[nodiscard]] double log2(double x);

/// Exponential, within 1 ulp.
[[nodiscard]] double exp(double x);
/// 2^x, within 1.1 ulp; exact for whole numbers.
[[nodiscard]] double exp2(double x);

/// x^y for x >= 0 and finite y, within 1 + 2 |log2(x^y)| ulp. 0^0 is 1.
[[nodiscard]] double pow(double x, double y);
/// x^n by multiplications, within n ulp. 0^0 is 1.
[[nodiscard]] double whole_power(double x, unsigned n);

/// Returns sqrt(a^2 + b^2) within 1.2 ulp. The squares do not overflow or vanish.
[[nodiscard]] double hypot(double a, double b);

} // namespace hemilux::elementary
