// The error of a picture against the light that it shows.
#include "parallel/workers.h"
#include "radiosity/answers/pictures/picture_error.h"
#include "radiosity/answers/pictures/picture_parts.h"
#include "radiosity/engine/rays/surface_point.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "support/catch.h"

#include <vector>

using namespace hemilux;
using test::Model;

namespace {

/// A furnace of emission 1 and reflectance 1/2: all surfaces send 2, of which they reflect 1.
struct Furnace {
    Model model{test::furnace_box(4, .5)};
    std::vector<Vec3> sent = std::vector<Vec3>(model.mesh.patches().size(), Vec3(2.0));
    SurfaceLight light{model.mesh, PatchLight(sent)};
    CameraRays camera{Camera{model.mesh.frame().to_world(Vec3(.1, .2, .3)),
                             model.mesh.frame().to_world(Vec3(-.9, -.3, -.4))},
                      model.mesh, 4. / 3};

    [[nodiscard]] PictureError error_of(float value, unsigned threads = 0) const {
        Image picture(160, 120);
        picture.pixels.assign(picture.pixels.size(), glm::vec3(value));
        return judge_of_pictures(model.mesh, model.bvh, light, camera, 160, 120, 1)
            .error_of(picture, 512, Workers(threads));
    }
};

} // namespace

TEST_CASE("the error of a picture is that of its pixels, relative to what is reflected") {
    const Furnace furnace;
    CHECK(furnace.error_of(2).error < 1e-6);
    CHECK(furnace.error_of(2.2f).error == Approx(.2).epsilon(1e-3));
    CHECK(furnace.error_of(1.9f).error == Approx(.1).epsilon(1e-3));
    CHECK(furnace.error_of(2.2f).rays > 10'000);
    CHECK(furnace.error_of(2.2f, 1).error == furnace.error_of(2.2f, 3).error);
}

TEST_CASE("what pixels show is estimated once for all pictures, and more pixels join the others") {
    const Furnace furnace;
    PictureJudge judge = judge_of_pictures(furnace.model.mesh, furnace.model.bvh, furnace.light,
                                           furnace.camera, 160, 120, 1);
    Image picture(160, 120);
    picture.pixels.assign(picture.pixels.size(), glm::vec3(2.2f));
    const Workers workers(0);
    const PictureError first = judge.error_of(picture, 512, workers);
    const PictureError more = judge.error_of(picture, 2048, workers);
    CHECK(more.error == Approx(.2).epsilon(1e-3));
    CHECK(more.rays > 2 * first.rays);
    CHECK(more.rays < 4 * first.rays); // but for those before
    picture.pixels.assign(picture.pixels.size(), glm::vec3(1.9f));
    const PictureError other = judge.error_of(picture, 512, workers);
    CHECK(other.error == Approx(.1).epsilon(1e-3));
    CHECK(other.rays == 0);
}

TEST_CASE("the parts of a picture lie on single faces that it shows, all over it") {
    const Furnace furnace;
    const std::vector<TargetPart> parts = picture_parts(furnace.model.mesh, furnace.model.bvh,
                                                        furnace.camera, 160, 120, 7, Workers(0));
    CHECK(parts.size() > 400);
    CHECK(parts.size() < 700);
    for (const TargetPart& part : parts) {
        REQUIRE(!part.points.empty());
        REQUIRE(part.reflectance.size() == part.points.size());
        for (std::size_t k = 0; k < part.points.size(); ++k) {
            const SurfacePoint& point = part.points[k];
            CHECK(point.facet == part.points[0].facet);
            CHECK(part.reflectance[k] == Vec3(.5));
            const Patch& patch = furnace.model.mesh.patches()[point.patch];
            CHECK(std::abs(glm::dot(point.position - patch.centre, patch.normal)) < 1e-9);
        }
    }
}
