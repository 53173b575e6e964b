// A coarse sphere whose texels gather around the normals of the sphere that it stands for.
#include "geometry/polygon.h"
#include "parallel/workers.h"
#include "radiosity/answers/charts/charts.h"
#include "radiosity/answers/lightmaps/lightmap_gather.h"
#include "radiosity/answers/lightmaps/lightmap_target.h"
#include "radiosity/answers/lightmaps/occlusion_gather.h"
#include "radiosity/light/lamps/emitter_shapes.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace hemilux;
using namespace hemilux::test;

namespace {

constexpr int size = 128;
constexpr std::uint32_t facets_of_sphere = 80;

/// A sphere of radius 1 around (0, height, 0): an icosahedron whose faces are divided by four.
Scene icosphere(double height) {
    const EmitterShape coarse = icosahedron(Vec3(0.0), 1);
    Scene scene;
    scene.groups = {"sphere"};
    scene.materials = {{"a", Vec3(0.5), Vec3(0.0)}};
    scene.vertices = coarse.points;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(scene.vertices.size()));
        if (is_new)
            scene.vertices.push_back(glm::normalize(scene.vertices[a] + scene.vertices[b]));
        return found->second;
    };
    for (const auto& face : coarse.faces) {
        const std::uint32_t a = face[0], b = face[1], c = face[2], ab = middle(a, b),
                            bc = middle(b, c), ca = middle(c, a);
        for (const auto& [x, y, z] : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                      std::array{ca, bc, c}, std::array{ab, bc, ca}})
            scene.facets.push_back({{x, y, z, z}, scene.faces++, 0, 0});
    }
    for (Vec3& vertex : scene.vertices)
        vertex.y += height;
    return scene;
}

/// The normals of the sphere at the corners of its facets; other facets have none.
std::vector<CornerNormals> normals_of(const Mesh& mesh, double height) {
    std::vector<CornerNormals> normals(mesh.scene().facets.size());
    for (std::uint32_t f = 0; f < facets_of_sphere; ++f)
        for (std::size_t k = 0; k < 4; ++k)
            normals[f][k] = glm::vec3(mesh.scene().vertices[mesh.scene().facets[f].vertex[k]] -
                                      Vec3(0, height, 0));
    return normals;
}

struct Off {
    double rms = 0, most = 0;
};

/// Compares the texels of the sphere with a function of the direction from its centre.
template <class Truth>
Off off_from(const GatheredLightmap& lightmap, const Mesh& mesh, const TexelMap& texels,
             double height, const Truth& truth) {
    Off off;
    std::size_t count = 0;
    for (std::size_t k = 0; k < texels.count(); ++k) {
        if (!texels.is_inside(k) || texels.triangle(k).facet >= facets_of_sphere)
            continue;
        const Vec3 out =
            glm::normalize(mesh.frame().to_world(texels.point(k).position) - Vec3(0, height, 0));
        const double by = std::abs(lightmap.image.pixels[k].x - truth(out));
        off.rms += by * by;
        off.most = std::max(off.most, by);
        ++count;
    }
    REQUIRE(count > 3000);
    off.rms = std::sqrt(off.rms / double(count));
    return off;
}

/// Charts of the sphere alone.
std::vector<PlacedTriangle> placed_sphere(const Mesh& mesh) {
    std::vector<ChartSide> sides;
    for (std::uint32_t f = 0; f < facets_of_sphere; ++f)
        sides.push_back({f, false});
    return placed_triangles(mesh, make_atlas(mesh, sides, {.size = size}).charts);
}

} // namespace

TEST_CASE("a coarse sphere above a wide ground is occluded as the sphere is", "[smooth]") {
    constexpr double height = 3, wide = 2000;
    Scene scene = icosphere(height);
    add_quad(scene, {-wide, 0, wide}, {wide, 0, wide}, {wide, 0, -wide}, {-wide, 0, -wide}, 1, 1,
             0);
    const Model model(std::move(scene));
    TexelMap texels(model.mesh, placed_sphere(model.mesh), size);
    const auto truth = [](const Vec3& out) { return (1 + out.y) / 2; };
    const auto gather = [&] {
        return gather_occlusion(model.mesh, model.bvh, texels, std::vector<bool>(texels.count()),
                                {.error = .003}, Workers(2))
            .lightmap;
    };
    const Off flat = off_from(gather(), model.mesh, texels, height, truth);
    const std::vector<CornerNormals> normals = normals_of(model.mesh, height);
    texels.set_normals(normals, model.bvh);
    const Off smooth = off_from(gather(), model.mesh, texels, height, truth);
    CAPTURE(flat.rms, flat.most, smooth.rms, smooth.most);
    CHECK(flat.rms > .04);
    CHECK(smooth.rms < .01);
    CHECK(smooth.most < .04);
}

TEST_CASE("the sun ends on a coarse sphere where it ends on the sphere", "[smooth]") {
    Scene scene = icosphere(0);
    const Vec3 to_sun = glm::normalize(Vec3(1, 2, .5));
    add_sun(scene, "sun", bounds_of(scene), -to_sun, Vec3(10.0));
    const Model model(std::move(scene));
    TexelMap texels(model.mesh, placed_sphere(model.mesh), size);
    std::vector<Vec3> sent;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        sent.push_back(model.mesh.material(i).emission);
    const SurfaceLight light(model.mesh, PatchLight(sent));
    const Workers workers(2);
    const auto gather = [&] {
        return gather_texels(model.mesh, model.bvh, light, texels,
                             std::vector<bool>(texels.count()),
                             {.bake = Bake::irradiance, .rays = 16}, workers);
    };
    const auto truth = [&](const Vec3& out) { return 10 * std::max(glm::dot(out, to_sun), 0.0); };
    const Off flat = off_from(gather(), model.mesh, texels, 0, truth);
    const std::vector<CornerNormals> normals = normals_of(model.mesh, 0);
    texels.set_normals(normals, model.bvh);
    const GatheredLightmap lightmap = gather();
    const Off smooth = off_from(lightmap, model.mesh, texels, 0, truth);
    CAPTURE(flat.rms, flat.most, smooth.rms, smooth.most);
    CHECK(flat.rms > .5);
    CHECK(smooth.rms < .05);
    CHECK(smooth.most < .15);
    // Between the limit of the light on the sphere and on the facets nothing is dark.
    for (std::size_t k = 0; k < texels.count(); ++k)
        if (texels.is_inside(k)) {
            const Vec3 out = glm::normalize(model.mesh.frame().to_world(texels.point(k).position));
            if (glm::dot(out, to_sun) > .05)
                REQUIRE(lightmap.image.pixels[k].x > 0);
            if (glm::dot(out, to_sun) < -.05)
                REQUIRE(lightmap.image.pixels[k].x == 0);
        }
    // The reported error is that of these texels.
    const std::vector<bool> covered(texels.count());
    CHECK(judge_of_lightmaps(model.mesh, model.bvh, light, texels, covered, Bake::irradiance, 3)
              .error_of(lightmap.image, 512, workers)
              .error < .03);
}

TEST_CASE("smooth points stay below what stands closely above, and above hollow facets",
          "[smooth]") {
    // A triangle whose normals lean outwards, a roof closely above it.
    Scene scene;
    scene.groups = {"all"};
    scene.materials = {{"a", Vec3(.5), Vec3(0)}};
    add_quad(scene, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {0, 0, 0}, 1, 1, 0);
    add_quad(scene, {0, .01, 0}, {1, .01, 0}, {1, .01, 1}, {0, .01, 1}, 1, 1, 0);
    const Model model(scene);
    const Mesh& mesh = model.mesh;
    const PlacedTriangle placed{0, false, false, 0, {}};
    SmoothTriangle triangle{corners_of(mesh, placed), {}};
    const Vec3 up = mesh.patches()[0].normal;
    const Vec3 middle = (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3.0;
    const SurfacePoint flat{middle, up, 0};
    for (const double lean : {.5, -.5}) { // bulging, and hollow
        for (std::size_t k = 0; k < 3; ++k)
            triangle.normal[k] =
                glm::normalize(up + lean * glm::normalize(triangle.corner[k] - middle));
        const SurfacePoint point = smooth_point(flat, triangle, 1 / 3., 1 / 3., model.bvh);
        CHECK(point.is_raised);
        CHECK(glm::dot(point.position - middle, up) > 0);
        CHECK(glm::dot(point.position - middle, up) < 1e-8);
        // A ray from below its plane meets the facet itself, and gets no light from beyond.
        const Vec3 along = glm::normalize(triangle.corner[0] - middle);
        const auto hit = model.bvh.closest(point.ray(glm::normalize(along - .1 * up)));
        REQUIRE(hit);
        CHECK(hit->facet == 0);
        CHECK(hit->front);
    }
    Scene open = scene;
    open.facets.pop_back();
    const Model free(open);
    triangle.corner = corners_of(free.mesh, placed);
    const Vec3 centre = (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k)
        triangle.normal[k] = glm::normalize(up + .5 * glm::normalize(triangle.corner[k] - centre));
    const SurfacePoint raised = smooth_point({centre, up, 0}, triangle, 1 / 3., 1 / 3., free.bvh);
    CHECK(glm::dot(raised.position - centre, up) > .05);
    // The normals of a plane, and those that look away, leave the point as it is.
    for (const double sign : {1., -1.}) {
        triangle.normal.fill(sign * up);
        const SurfacePoint same = smooth_point({centre, up, 0}, triangle, .2, .3, free.bvh);
        CHECK_FALSE(same.is_raised);
        CHECK(same.normal == up);
    }
}
