#include "radiosity/answers/views/view_candidates.h"

#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

constexpr double outside_fov = 40, inside_fov = 60; // vertical [degrees]

/// Directions that go with the axis upwards: to the right, up, and forward out of the picture.
struct Axes {
    Vec3 right{1, 0, 0}, up{0.0}, front{0.0};
    explicit Axes(int axis) {
        up[axis] = 1;
        front = glm::cross(right, up);
    }
    /// Returns a unit vector by the angles from the front to the right, and upwards [degrees].
    [[nodiscard]] Vec3 direction(double azimuth, double elevation) const {
        const Vec2 around = elementary::on_circle(azimuth * std::numbers::pi / 180);
        const Vec2 above = elementary::on_circle(elevation * std::numbers::pi / 180);
        return above.x * (around.x * front + around.y * right) + above.y * up;
    }
};

/// Returns a camera outside the box, as near as the whole box fits into the picture.
Camera outside_camera(const Box& box, const Vec3& up, const Vec3& toward_eye, double aspect) {
    const double tan_y = elementary::tan(outside_fov * std::numbers::pi / 360),
                 tan_x = aspect * tan_y;
    const Vec3 right = glm::normalize(glm::cross(up, toward_eye));
    const Vec3 upward = glm::cross(toward_eye, right), centre = box.centre();
    double distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 q = 0.51 * box.extent() *
                       Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const double across =
            std::max(std::abs(glm::dot(q, right)) / tan_x, std::abs(glm::dot(q, upward)) / tan_y);
        distance = std::max(distance, across + glm::dot(q, toward_eye));
    }
    return {centre + distance * toward_eye, centre, up, outside_fov};
}

/// Returns how much better a thing is seen from a corner of its front, a little from above.
double taste_of(double azimuth, double elevation) {
    const double turned = std::min(azimuth, 360 - azimuth); // from the front
    const double around = turned < 10 ? 0.85 : turned < 60 ? 1 : turned < 100 ? 0.85 : 0.75;
    const double above = elevation < 10 ? 0.8 : elevation < 40 ? 1 : 0.8;
    return around * above;
}

void add_outside(std::vector<ViewCandidate>& views, const Axes& axes, const Box& box,
                 double aspect) {
    constexpr std::array<double, 16> azimuths = {0,   22.5,  337.5, 45,  315, 67.5,  292.5, 90,
                                                 270, 112.5, 247.5, 135, 225, 157.5, 202.5, 180};
    for (const double elevation : {0.0, 15.0, 30.0, 50.0})
        for (const double azimuth : azimuths)
            views.push_back(
                {outside_camera(box, axes.up, axes.direction(azimuth, elevation), aspect),
                 ViewKind::object, taste_of(azimuth, elevation)});
}

/// Adds views from the middles of about 500 cells of the box.
void add_within(std::vector<ViewCandidate>& views, const Axes& axes, const Box& box) {
    constexpr double flat = 1e-3; // as thick as a flat scene is taken to be
    const double thick = flat * glm::length(box.extent());
    const auto along = [&](const Vec3& axis) {
        return std::max(std::abs(glm::dot(box.extent(), axis)), thick);
    };
    const Vec3 extent(along(axes.right), along(axes.up), along(axes.front));
    const double ahead = .5 * glm::length(box.extent()); // the target is a place to read and change
    const Vec3 n = glm::clamp(
        glm::round(extent / elementary::pow(extent.x * extent.y * extent.z / 500, 1.0 / 3)), 1.0,
        64.0);
    for (double x = 0.5; x < n.x; ++x)
        for (double y = 0.5; y < n.y; ++y)
            for (double z = 0.5; z < n.z; ++z)
                for (double azimuth = 22.5; azimuth < 360; azimuth += 45) {
                    const Vec3 from_centre = extent * (Vec3(x, y, z) / n - 0.5);
                    const Vec3 eye = box.centre() + from_centre.x * axes.right +
                                     from_centre.y * axes.up + from_centre.z * axes.front;
                    views.push_back(
                        {{eye, eye + ahead * axes.direction(azimuth, -10), axes.up, inside_fov},
                         ViewKind::within,
                         1});
                }
}

/// Adds views at patches from where rays that leave them end.
void add_facing(std::vector<ViewCandidate>& views, const Mesh& mesh, const Tracer& tracer,
                const Axes& axes, const ViewSubject& subject) {
    constexpr double short_of_wall = 0.9, grazing = 0.2;
    const double far = 0.6 * glm::length(subject.box.extent());
    for (const std::uint32_t index : subject.front)
        for (const double elevation : {8.0, 25.0})
            for (double azimuth = 22.5; azimuth < 360; azimuth += 45) {
                const Patch& patch = mesh.patches()[index];
                const Vec3 out = axes.direction(azimuth, elevation);
                if (glm::dot(out, patch.normal) < grazing)
                    continue;
                const auto hit =
                    tracer.closest({.origin = patch.centre, .direction = out, .from = patch.facet});
                const double free = hit ? short_of_wall * hit->t : far;
                views.push_back(
                    {{patch.centre + std::min(free, far) * out, patch.centre, axes.up, inside_fov},
                     ViewKind::facing,
                     1});
            }
}

} // namespace

std::vector<ViewCandidate> view_candidates(const Mesh& mesh, const Tracer& tracer,
                                           const ViewSubject& subject) {
    const Axes axes(subject.up);
    std::vector<ViewCandidate> views;
    constexpr double about_all = 0.8;
    add_outside(views, axes, subject.box, subject.aspect);
    if (subject.lit.half_area() < about_all * subject.box.half_area())
        add_outside(views, axes, subject.lit, subject.aspect);
    add_within(views, axes, subject.box);
    add_facing(views, mesh, tracer, axes, subject);
    return views;
}

} // namespace hemilux
