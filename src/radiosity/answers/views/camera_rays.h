#pragma once
// The rays of a pinhole camera, and what they show first.

#include "bvh/tracer.h"
#include "radiosity/answers/views/camera.h"

#include <optional>

namespace hemilux {

class Mesh;

/// The rays of a camera, in the local frame of a mesh.
class CameraRays {
  public:
    /// `aspect` is width over height. Throws std::invalid_argument if eye and target are one point.
    CameraRays(const Camera& camera, const Mesh& mesh, double aspect);
    /// Returns the ray through a place of the picture: x from 0 (left) to 1, y from 0 (top) to 1.
    /// Its direction has unit length.
    [[nodiscard]] Ray ray(double x, double y) const;
    [[nodiscard]] const Vec3& eye() const { return eye_; }
    /// Returns the direction of that ray, not of unit length: it is linear in x and y, and its part
    /// along the view is 1.
    [[nodiscard]] Vec3 direction(double x, double y) const {
        return forward_ + (2 * x - 1) * right_ + (1 - 2 * y) * up_;
    }

  private:
    Vec3 eye_, forward_, right_, up_; ///< the last two reach from the centre to the picture's edges
};

/// The first surface that a ray of a picture shows. The backs of one-sided facets are looked
/// through, so that an interior can be seen from outside.
struct Visible {
    Hit hit; ///< hit with t along the ray
    std::uint32_t patch;
    std::uint32_t backs; ///< facets looked through
};
[[nodiscard]] std::optional<Visible> look(const Mesh& mesh, const Tracer& tracer, Ray ray);

} // namespace hemilux
