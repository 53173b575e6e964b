// Backs that face a patch, against a look at each facet.
#include "radiosity/engine/factors/pairs/facing_backs.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;

namespace {

/// Squares of all tilts in a flat box, so that few or many lie behind others.
Scene scattered(std::uint64_t seed, int count, double height, double most_tilt) {
    Rng random(seed);
    Scene scene = test::bare_scene();
    for (int k = 0; k < count; ++k) {
        const double tilt = most_tilt * random.uniform(), turn = 6.28 * random.uniform();
        const Vec3 normal(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                          std::cos(tilt)),
            u = .1 * glm::normalize(glm::cross(normal, Vec3(.31, .17, .93))),
            v = glm::cross(normal, u);
        const Vec3 at(random.uniform(), random.uniform(), height * random.uniform());
        test::add_quad(scene, at, at + u, at + u + v, at + v, 1, 1, 0);
    }
    return scene;
}

bool is_faced(const Mesh& mesh, const Patch& patch) {
    const auto rises = [&](const Vec3& corner) {
        return glm::dot(patch.normal, corner - patch.shape.corner[0]) > 1e-9;
    };
    for (std::uint32_t facet = 0; facet < mesh.scene().facets.size(); ++facet) {
        const Polygon shape = mesh.shape_of(facet);
        const Vec3 front = glm::normalize(shape.area_vector());
        const auto is_behind = [&](const Vec3& corner) {
            return glm::dot(front, corner - shape.corner[0]) < -1e-9;
        };
        if (!mesh.has_back(facet) && std::ranges::any_of(shape.corner, rises) &&
            std::ranges::any_of(patch.shape.corner, is_behind))
            return true;
    }
    return false;
}

} // namespace

TEST_CASE("Backs face a patch where one of all facets does, in any order of patches") {
    std::size_t faced = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const int count = seed % 3 == 0 ? 300 : 6;
        const test::Model model(
            scattered(seed, count, seed % 2 == 0 ? 1 : .02, seed % 5 == 0 ? 3.1 : .4));
        const FacingBacks backs(model.mesh);
        FacingBacks::Last last{};
        for (std::size_t k = 0; k < model.mesh.patches().size(); ++k) {
            const Patch& patch = model.mesh.patches()[(7 * k) % model.mesh.patches().size()];
            const bool expected = is_faced(model.mesh, patch);
            CHECK(backs.face(patch, last) == expected);
            faced += expected ? 1 : 0;
            ++all;
        }
    }
    CHECK(faced > all / 10);
    CHECK(faced < all);
}

TEST_CASE("No back faces the inside of a closed room") {
    Scene room = test::bare_scene();
    for (int axis = 0; axis < 3; ++axis)
        for (const double end : {0.0, 1.0}) {
            Vec3 at(0.0), u(0.0), v(0.0);
            at[axis] = end;
            u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
            if (end > 0)
                std::swap(u, v);
            test::add_quad(room, at, at + u, at + u + v, at + v, 5, 5, 0);
        }
    const test::Model model(room);
    const FacingBacks backs(model.mesh);
    FacingBacks::Last last{};
    for (const Patch& patch : model.mesh.patches())
        CHECK_FALSE(backs.face(patch, last));
}
