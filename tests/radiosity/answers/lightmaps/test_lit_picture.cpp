// The picture of surfaces as they are lit: colours of textures times the light of a lightmap.
#include "parallel/workers.h"
#include "radiosity/answers/lightmaps/lit_picture.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <cstdint>
#include <memory>
#include <vector>

using namespace hemilux;

namespace {

/// A square of 1 x 1 m that emits .25, with a texture of side x side texels in a chessboard of
/// black and white.
Mesh textured_square(std::uint32_t side) {
    Scene scene;
    scene.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    scene.materials = {{.name = "board", .reflectance = Vec3(.5), .emission = Vec3(.25)}};
    scene.groups = {"square"};
    scene.facets = {{{0, 1, 2, 3}, 0, 0, 0}};
    scene.faces = 1;
    std::vector<std::uint8_t> rgb;
    for (std::uint32_t k = 0; k < side * side; ++k)
        rgb.insert(rgb.end(), 3, (k / side + k) % 2 == 0 ? 255 : 0);
    SceneTextures& textures = own_textures_of(scene);
    textures.texcoords = {{Texcoords{glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}}};
    textures.of_material.resize(1);
    textures.of_material[0].reflectance.texture =
        std::make_shared<Texture>(side, side, std::move(rgb), srgb_to_linear());
    return Mesh(scene);
}

/// The square fills the middle of a lightmap of 8 x 8 texels.
std::vector<PlacedTriangle> placed_square() {
    return {{0, false, false, 0, {Vec2(2, 2), {6, 2}, {6, 6}}},
            {0, false, true, 0, {Vec2(2, 2), {6, 6}, {2, 6}}}};
}

} // namespace

TEST_CASE("a lit picture has the texels of textures and the light between those of a lightmap") {
    constexpr std::uint32_t side = 12;
    const Mesh mesh = textured_square(side);
    CHECK(texture_density(mesh, placed_square()) == Approx(3));
    Image light(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            light.at(x, y) = glm::vec3(float(x) + .5f, 1, float(y) + .5f);
    const LitPicture picture = lit_picture(mesh, placed_square(), light, 3, 1, Workers(2));
    REQUIRE(picture.light.width == 24);
    CHECK(picture.cover.empty());
    for (int y = 6; y < 18; ++y)
        for (int x = 6; x < 18; ++x) {
            const float white = (x + y) % 2 == 0 ? 1 : 0;
            const glm::vec3 shown = picture.light.at(x, y);
            CHECK(shown.r == Approx(.25 + white * (x + .5) / 3));
            CHECK(shown.g == Approx(.25 + white));
            CHECK(shown.b == Approx(.25 + white * (y + .5) / 3));
            CHECK(picture.emitted.at(x, y) == glm::vec3(.25f));
        }
    CHECK(picture.light.at(0, 12) == glm::vec3(0.0f)); // beyond the margin
    CHECK(picture.light.at(4, 12).g > 0);              // within it
}

TEST_CASE("a lit picture that is coarser than a texture has means of it") {
    const Mesh mesh = textured_square(8);
    Image light(8, 8);
    for (glm::vec3& texel : light.pixels)
        texel = glm::vec3(1.0f);
    const LitPicture picture = lit_picture(mesh, placed_square(), light, 1, 1, Workers(1));
    for (int y = 2; y < 6; ++y)
        for (int x = 2; x < 6; ++x)
            CHECK(picture.light.at(x, y).r == Approx(.75)); // half of it is white
}
