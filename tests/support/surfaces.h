#pragma once
// What a linear system of radiosity takes, by patch.

#include "radiosity/scene/mesh.h"

#include <cstdint>
#include <vector>

namespace hemilux::test {

struct Surfaces {
    std::vector<double> area; ///< local units
    std::vector<Vec3> reflectance, emission;

    explicit Surfaces(const Mesh& mesh) {
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
            area.push_back(mesh.patches()[i].area);
            reflectance.push_back(mesh.material(i).reflectance);
            emission.push_back(mesh.material(i).emission);
        }
    }
};

} // namespace hemilux::test
