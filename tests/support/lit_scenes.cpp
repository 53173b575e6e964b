#include "support/lit_scenes.h"

#include "support/scenes.h"

#include <array>
#include <cstddef>

namespace hemilux::test {

Scene pavilion(int open_side, double emission) {
    Scene scene;
    scene.materials = {{"wall", Vec3(0.4), Vec3(0)}, {"lamp", Vec3(0.3), Vec3(emission)}};
    scene.groups = {"pavilion"};
    add_quad(scene, {-6, 0, -6}, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, 24, 24, 0);
    const std::array<std::array<Vec3, 2>, 4> walls = {{{Vec3(2, 0, 2), Vec3(2, 0, -2)},
                                                       {Vec3(-2, 0, -2), Vec3(-2, 0, 2)},
                                                       {Vec3(-2, 0, 2), Vec3(2, 0, 2)},
                                                       {Vec3(2, 0, -2), Vec3(-2, 0, -2)}}};
    const Vec3 up(0, 2.6, 0);
    for (std::size_t side = 0; side < walls.size(); ++side)
        if (static_cast<int>(side) != open_side)
            add_quad(scene, walls[side][0], walls[side][1], walls[side][1] + up,
                     walls[side][0] + up, 8, 5, 0);
    add_quad(scene, {-2, 2.6, -2}, {2, 2.6, -2}, {2, 2.6, 2}, {-2, 2.6, 2}, 4, 4, 1);
    return scene;
}

Scene lamp_in_case() {
    const std::vector<Material> materials = {{"wall", Vec3(0.5), Vec3(0)},
                                             {"lamp", Vec3(0), Vec3(1)}};
    Scene scene = box_room({0, 0, 0}, {8, 3, 8}, 6, materials, {});
    scene.groups = {"room", "case", "lamp"};
    const std::size_t room = scene.facets.size();
    const Scene small = box_room({5, 0.1, 5}, {5.5, 0.6, 5.5}, 3, {materials[0]}, {});
    add_scene(scene, small);
    for (std::size_t f = room; f < scene.facets.size(); ++f)
        scene.facets[f].group = 1;
    add_quad(scene, {5.2, 0.55, 5.2}, {5.3, 0.55, 5.2}, {5.3, 0.55, 5.3}, {5.2, 0.55, 5.3}, 1, 1,
             1);
    scene.facets.back().group = 2;
    return scene;
}

Scene standing_thing() {
    Scene scene;
    scene.materials = {{"wood", Vec3(0.5), Vec3(0)}};
    scene.groups = {"thing"};
    add_block(scene, {-0.2, 0, -0.2}, {0.2, 0.05, 0.2});
    add_block(scene, {-0.05, 0.05, -0.05}, {0.05, 0.8, 0.05});
    add_block(scene, {-0.15, 0.8, -0.15}, {0.15, 0.9, 0.15});
    return scene;
}

Scene turned_to_z(Scene scene) {
    for (Vec3& v : scene.vertices)
        v = turned_to_z(v);
    return scene;
}

} // namespace hemilux::test
