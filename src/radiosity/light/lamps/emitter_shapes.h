#pragma once
// Surfaces that stand for lights which a scene has not modelled: small emitters of a few faces, the
// sun, the sky. Radiosity knows emitting surfaces only.

#include "geometry/box.h"
#include "radiosity/paper/scene/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hemilux {

/// Faces that shine to their fronts.
struct EmitterShape {
    std::vector<Vec3> points;                        ///< world units [m]
    std::vector<std::array<std::uint32_t, 4>> faces; ///< indices of points; a triangle: [3] == [2]
    [[nodiscard]] double area() const;               ///< [m2]
};

/// Makes a regular polygon of twelve corners, inscribed in the circle.
[[nodiscard]] EmitterShape disc(const Vec3& centre, const Vec3& normal, double radius);
/// Makes one quad. Its width lies across the normal and the coordinate axis nearest to being
/// perpendicular to it. So an emitter that shines down is parallel to the walls of most rooms.
[[nodiscard]] EmitterShape rectangle(const Vec3& centre, const Vec3& normal, double width,
                                     double height);
/// Makes a regular icosahedron with this circumscribed radius, whose faces look outwards.
[[nodiscard]] EmitterShape icosahedron(const Vec3& centre, double radius);

/// Adds the faces with a black material and a group of this name. `emission` is the radiosity of
/// the faces [W/m2], `is_far` is Material::is_far.
void add_emitter(Scene& scene, const EmitterShape& shape, const std::string& name,
                 const Vec3& emission, bool is_far = false);

/// Returns the box of the facets that are not far, in world units [m].
[[nodiscard]] Box bounds_of(const Scene& scene);

/// Adds a disc of the sun's angular radius, 0.00465 rad, at a hundred times the size of the scene,
/// whose bounds are `within`. From end to end of the scene its direction differs by 0.01 rad, as
/// much as the sun is wide. `irradiance` is that of a surface that faces it [W/m2]. The light goes
/// along `direction`, which has any length above 0.
void add_sun(Scene& scene, const std::string& name, const Box& within, const Vec3& direction,
             const Vec3& irradiance);
/// Adds an enclosure of one radiosity [W/m2] on the inside, beyond suns. From any place within, it
/// looks the same in all directions. A surface that sees nothing else has an irradiance equal to
/// that radiosity.
void add_sky(Scene& scene, const std::string& name, const Box& within, const Vec3& radiosity);

} // namespace hemilux
