#pragma once
// Describes a light without extent: a place that shines into directions.
//
// At distance r, a surface whose normal is turned by theta from the way to it has the irradiance
//
//     E = I(direction) cos(theta) / r^2.
//
// The cone of a spot is that of KHR_lights_punctual: within the inner cone all of I, outside of the
// outer one none, and between them I ((cos - cos_outer) / (cos_inner - cos_outer))^2. A measured
// lamp has a table of intensities (candela_table.h), in which a candela counts as a watt per
// steradian.

#include "geometry/vector.h"

#include <memory>
#include <span>
#include <string>

namespace hemilux {

class CandelaTable;
struct Scene;

struct PointEmitter {
    std::string name;
    Vec3 position{0.0};                    ///< world units [m]
    Vec3 axis{0, 0, -1};                   ///< unit, the middle of the cone; nadir of a table
    Vec3 intensity{0.0};                   ///< I on the axis [W/sr]; with a table, factors of it
    double cos_inner = -2, cos_outer = -2; ///< cosines of the cones; -2: it shines all around
    std::shared_ptr<const CandelaTable> table = {};
    Vec3 side{1, 0, 0}; ///< unit, across the axis: where C = 0 of the table

    [[nodiscard]] bool is_spot() const { return cos_outer >= -1; }
};

/// Returns the intensity in a unit direction away from the light, over PointEmitter::intensity.
[[nodiscard]] double relative_intensity(const PointEmitter& emitter, const Vec3& direction);
/// Returns the largest of all directions.
[[nodiscard]] double max_relative_intensity(const PointEmitter& emitter);
/// Returns an upper bound of it for directions within an angle of `direction`, whose cosine and
/// sine are given.
[[nodiscard]] double max_relative_intensity(const PointEmitter& emitter, const Vec3& direction,
                                            double cosine, double sine);
/// Returns a direction uniform within the outer cone for u uniform in [0,1)^2.
[[nodiscard]] Vec3 random_direction(const PointEmitter& emitter, Vec2 u);
/// Returns the power [W] over PointEmitter::intensity.
[[nodiscard]] double power_per_intensity(const PointEmitter& emitter);

/// Returns the lights without extent of a scene.
[[nodiscard]] std::span<const PointEmitter> point_emitters_of(const Scene& scene);
/// Returns the power that they emit [W].
[[nodiscard]] Vec3 power_of_point_emitters(const Scene& scene);
/// Adds a light to a scene. Throws std::invalid_argument if its numbers are not finite, or an
/// intensity is below 0.
void add_point_emitter(Scene& scene, const PointEmitter& emitter);

} // namespace hemilux
