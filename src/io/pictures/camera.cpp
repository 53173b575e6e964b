#include "io/pictures/camera.h"

#include "geometry/elementary.h"
#include "geometry/frame.h"
#include "io/files/text_words.h"
#include "radiosity/paper/scene/mesh.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
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

CameraRays::CameraRays(const Camera& camera, const Mesh& mesh, double aspect)
    : eye_(mesh.frame().to_local(camera.eye)) {
    const Vec3 view = mesh.frame().to_local(camera.target) - eye_;
    if (!(glm::length(view) > 0))
        throw std::invalid_argument("a camera's eye and target must be different points");
    forward_ = glm::normalize(view);
    const Vec3 side = glm::cross(forward_, camera.up);
    constexpr double parallel = 1e-6; // looking straight up or down: any side does
    const Vec3 right = glm::length(side) > parallel * glm::length(camera.up)
                           ? glm::normalize(side)
                           : Frame::from_normal(forward_).x;
    const double half = elementary::tan(camera.vertical_fov_degrees * std::numbers::pi / 360);
    right_ = half * aspect * right;
    up_ = half * glm::cross(right, forward_);
}

Ray CameraRays::ray(double x, double y) const {
    return {.origin = eye_, .direction = glm::normalize(direction(x, y))};
}

std::optional<Visible> look(const Mesh& mesh, const Tracer& tracer, Ray ray) {
    constexpr double same_place = 1e-12; // sheets modelled back to back
    constexpr std::uint32_t max_backs = 10'000;
    double last = -std::numeric_limits<double>::infinity();
    for (std::uint32_t backs = 0; backs < max_backs; ++backs) {
        const std::optional<Hit> hit = tracer.closest(ray);
        if (!hit)
            return std::nullopt;
        if (const std::uint32_t patch = mesh.patch_at(*hit); patch != none)
            return Visible{*hit, patch, backs};
        // A front that coincides with this back is still to be seen; but go on from a second back.
        ray.t_min = hit->t > last + same_place ? hit->t - same_place : hit->t + same_place;
        ray.from = hit->facet;
        last = hit->t;
    }
    return std::nullopt;
}

} // namespace hemilux
