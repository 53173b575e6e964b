#include "radiosity/answers/views/camera_rays.h"

#include "geometry/elementary.h"
#include "geometry/frame.h"
#include "radiosity/paper/scene/mesh.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace hemilux {

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
