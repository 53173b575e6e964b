#include "radiosity/paper/scene/varying_colours.h"

#include "radiosity/paper/scene/mesh.h"

namespace hemilux {

Colours colours_at(const Mesh& mesh, const Patch& patch, const Vec3& point) {
    if (mesh.scene().colours_vary_on(patch.material))
        return mesh.scene().varying->at(mesh, patch, point);
    const Material& material = mesh.material(patch);
    return {material.reflectance, material.emission};
}

} // namespace hemilux
