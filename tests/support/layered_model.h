#pragma once
// A mesh as the program makes it of any scene, with faces that lie over each other set apart.

#include "radiosity/light/layers/layered_mesh.h"
#include "support/solve.h"

#include <utility>

namespace hemilux::test {

struct LayeredModel : Model {
    explicit LayeredModel(Scene scene, const MeshOptions& options = {})
        : Model(layered_mesh(std::move(scene), options)) {}
};

} // namespace hemilux::test
