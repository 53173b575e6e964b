#pragma once
// Gathers what a linear system of radiosity takes, by patch.

#include "radiosity/paper/scene/mesh.h"

#include <vector>

namespace hemilux {

struct Surfaces {
    std::vector<double> area;      ///< local units
    std::vector<Vec3> reflectance; ///< [-]
    std::vector<Vec3> emission;    ///< [W/m2]

    explicit Surfaces(const Mesh& mesh) {
        const auto patches = mesh.patches();
        area.reserve(patches.size());
        reflectance.reserve(patches.size());
        emission.reserve(patches.size());
        for (const Patch& patch : patches) {
            area.push_back(patch.area);
            reflectance.push_back(mesh.material(patch).reflectance);
            emission.push_back(mesh.material(patch).emission);
        }
    }
};

} // namespace hemilux
