#pragma once
// This maps linear light to what a screen can show.
//
// Screens end at 1. Cutting each channel there (Tone::srgb) changes hues: a warm wall of (1.6, 1.2,
// 0.5) becomes (1, 1, 0.5), a greenish yellow. Tone::neutral compresses the largest channel and
// scales the other two alike, so that the hue stays. It moves very bright colours towards white.
// This is the "PBR Neutral" curve of the Khronos Group (2024), without its offset for the
// reflections of glossy surfaces. With p = max(R,G,B), s = 0.8, d = 0.15:
//
//   p <= s: nothing changes;
//   else    q = 1 - (1 - s)^2 / (p + 1 - 2 s),   g = 1 / (d (p - q) + 1),
//           colour = g (q / p) (R,G,B) + (1 - g) (q,q,q).
//
// q rises from s to 1, and its slope is 1 in s.

#include <glm/glm.hpp>

namespace hemilux {

enum class Tone { neutral, srgb };

/// The way in which light is shown: it is multiplied by the exposure, then passed through the
/// curve.
struct Display {
    double exposure = 1;
    Tone tone = Tone::srgb;
    Display() = default;
    Display(double exposure_, Tone tone_ = Tone::srgb) : exposure(exposure_), tone(tone_) {}

    /// Maps linear light to linear [0,1] per channel; NaN becomes 0.
    [[nodiscard]] glm::vec3 operator()(const glm::vec3& light) const;
};

} // namespace hemilux
