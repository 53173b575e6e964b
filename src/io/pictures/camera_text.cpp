#include "io/pictures/camera_text.h"

#include "io/files/text_words.h"

#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

namespace hemilux {

std::optional<Camera> parse_camera(std::string_view text) {
    std::vector<double> n;
    for (const std::string_view part : parts_of(text, ',')) {
        const std::string_view word = trimmed(part);
        const char* const end = word.data() + word.size();
        double number = 0;
        const auto [rest, error] = std::from_chars(word.data(), end, number);
        if (error != std::errc() || rest != end || !std::isfinite(number))
            return std::nullopt;
        n.push_back(number);
    }
    if (n.size() != 6 && n.size() != 7 && n.size() != 10)
        return std::nullopt;
    Camera camera{.eye = {n[0], n[1], n[2]}, .target = {n[3], n[4], n[5]}};
    if (n.size() > 6)
        camera.vertical_fov_degrees = n[6];
    if (n.size() > 7)
        camera.up = {n[7], n[8], n[9]};
    const bool can_be = camera.eye != camera.target && camera.up != Vec3(0.0) &&
                        camera.vertical_fov_degrees > 0 && camera.vertical_fov_degrees < 180;
    return can_be ? std::optional(camera) : std::nullopt;
}

} // namespace hemilux
