#include "radiosity/answers/images/tone.h"
#include "radiosity/answers/picture_check/picture_check.h"

#include "radiosity/answers/picture_check/place_of_light.h"
#include "radiosity/answers/pictures/render.h"
#include "support/catch.h"
#include "support/lit_scenes.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;
using namespace hemilux::test;

namespace {

struct Checked {
    Model model;
    std::vector<Vec3> radiosity;

    explicit Checked(Scene scene)
        : model(std::move(scene), {.two_sided = true}),
          radiosity(
              solve(model, *find_method("stored-transport"), {.rays = 64}, steps(1)).radiosity) {}

    /// Returns the warning of a picture, by the automatic exposure where none is given.
    [[nodiscard]] std::string warning(const Camera& camera, double exposure = 0) const {
        const Image picture = render(model.mesh, model.bvh, radiosity, camera,
                                     {.width = 96, .height = 72, .samples = 1});
        if (!(exposure > 0))
            exposure = exposure_of(picture, model.mesh, model.bvh, camera);
        return picture_warning(
            {picture, Display(exposure, Tone::neutral), model.mesh, model.bvh, radiosity, camera});
    }
};

} // namespace

TEST_CASE("A picture that shows what is lit has no warning") {
    for (const int side : {0, 1, 2, 3}) {
        const Checked scene(pavilion(side));
        CHECK(scene.warning(automatic_camera(scene.model.mesh, scene.model.bvh, scene.radiosity))
                  .empty());
    }
}

TEST_CASE("A picture of nothing says so, and what else there is to see") {
    const Checked scene(pavilion(2));
    CHECK_THAT(scene.warning({.eye = {0, 1, 20}, .target = {0, 1, 30}}),
               Catch::Contains("black: the camera sees nothing of the scene") &&
                   Catch::Contains("--camera auto shows what is lit"));
}

TEST_CASE("A picture filled by a lamp names it") {
    const Checked scene(pavilion(2));
    CHECK_THAT(scene.warning({.eye = {0, 5, 0}, .target = {0, 0, 0.1}}),
               Catch::Contains("white: lamps fill 100 % of it, most of them 'pavilion'"));
}

TEST_CASE("An exposure given that shows nothing is named beside the automatic one") {
    const Checked scene(pavilion(2));
    const Camera camera = automatic_camera(scene.model.mesh, scene.model.bvh, scene.radiosity);
    CHECK_THAT(scene.warning(camera, 1e-4), Catch::Contains("black: --exposure 0.0001"));
    CHECK_THAT(scene.warning(camera, 1e6), Catch::Contains("white: --exposure 1e+06"));
}

TEST_CASE(
    "Light that stays in a case is reported by the name of the case, from outside and inside") {
    const Checked scene(lamp_in_case());
    const char* const stays = "of the light stays inside 'case', 0.5 wide in a scene of 8";
    CHECK_THAT(scene.warning({.eye = {1, 2, 1}, .target = {5, 0, 5}}),
               Catch::Contains(std::string("the picture is black: ")) && Catch::Contains(stays) &&
                   Catch::Contains("the camera sees none of it") &&
                   Catch::Contains("--camera auto"));
    CHECK_THAT(scene.warning(automatic_camera(scene.model.mesh, scene.model.bvh, scene.radiosity)),
               Catch::Contains(stays) && Catch::Contains("the rest of the scene is dark"));
    const PlaceOfLight place = place_of_light(scene.model.mesh, scene.model.bvh, scene.radiosity);
    CHECK(place.enclosed);
    CHECK(place.of_light > 0.99);
    CHECK(place.of_area < 0.05);
}

TEST_CASE("Light in the open does not stay where it is") {
    const Checked scene(pavilion(2));
    CHECK_FALSE(place_of_light(scene.model.mesh, scene.model.bvh, scene.radiosity).enclosed);
}

TEST_CASE("Where no surface reflects light the picture says so") {
    Scene black = pavilion(2);
    for (Material& material : black.materials)
        material.reflectance = Vec3(0.0);
    const Checked scene(std::move(black));
    CHECK_THAT(scene.warning({.eye = {0, 1, 12}, .target = {0, -2, 0}}),
               Catch::Contains("black: no surface reflects light"));
}
