#include "radiosity/answers/images/tone.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

glm::vec3 neutral(const glm::vec3& colour) {
    constexpr float start = 0.8f, desaturation = 0.15f, room = 1 - start;
    const float peak = std::max({colour.r, colour.g, colour.b});
    if (!(peak > start) || !std::isfinite(peak))
        return colour;
    const float compressed = 1 - room * room / (peak + room - start);
    const float kept = 1 / (desaturation * (peak - compressed) + 1);
    return kept * (compressed / peak) * colour + (1 - kept) * glm::vec3(compressed);
}

float within_screen(float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; } // NaN is black

} // namespace

glm::vec3 Display::operator()(const glm::vec3& light) const {
    glm::vec3 colour;
    for (int channel = 0; channel < 3; ++channel)
        colour[channel] = static_cast<float>(exposure * static_cast<double>(light[channel]));
    if (tone == Tone::neutral)
        colour = neutral(colour);
    return {within_screen(colour.r), within_screen(colour.g), within_screen(colour.b)};
}

} // namespace hemilux
