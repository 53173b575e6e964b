#include "radiosity/light/cached_light/patch_light.h"

#include "geometry/frame.h"
#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

Vec3 radiosity_at(const Mesh& mesh, const PatchLight& light, std::uint32_t patch,
                  const Vec3& point) {
    if (light.slope.empty())
        return light.radiosity[patch];
    const Patch& on = mesh.patches()[patch];
    const Frame frame = Frame::from_normal(on.normal);
    const Vec3 way = point - on.centre;
    const Slope& slope = light.slope[patch];
    const Vec3 rise = glm::dot(way, frame.x) * slope.x + glm::dot(way, frame.y) * slope.y;
    return glm::max(light.radiosity[patch] + rise, mesh.material(on).emission);
}

} // namespace hemilux
