#pragma once
// Positive numbers in one byte, as logarithms: eighths of an octave from 2^-16 to 2^15.75. So each
// is kept within 4.5 %. What lies beyond an end becomes the number at that end, and 0 is 0.

#include "geometry/elementary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hemilux::log_byte {

inline constexpr std::size_t values = 256;
inline constexpr double steps_per_octave = 8, lowest_octave = -16;

/// NaN and what is not positive become 0.
[[nodiscard]] inline std::uint8_t from(double number) {
    if (!(number > 0))
        return 0;
    const double step = std::round(steps_per_octave * (elementary::log2(number) - lowest_octave));
    return static_cast<std::uint8_t>(1 + std::clamp(step, 0.0, 254.0));
}

[[nodiscard]] inline double value(std::size_t byte) {
    const double octave = (static_cast<double>(byte) - 1) / steps_per_octave + lowest_octave;
    return byte == 0 ? 0 : elementary::exp2(octave);
}

} // namespace hemilux::log_byte
