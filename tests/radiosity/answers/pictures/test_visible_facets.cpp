// What is filled row by row is what rays of the camera see.
#include "bvh/wide/wide_bvh.h"
#include "radiosity/answers/pictures/visible_facets.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/scenes.h"

#include <array>
#include <cmath>

using namespace hemilux;
using namespace hemilux::test;

namespace {

constexpr int width = 61, height = 43;
constexpr std::array<Vec2, 3> offsets{Vec2(.5, .5), Vec2(.1, .8), Vec2(.77, .03)};

/// Triangles and quads of all sizes around the origin, some through the eye's plane.
Scene crowd(std::uint64_t seed) {
    Scene scene;
    scene.materials = {{"all", Vec3(.5), Vec3(0)}};
    scene.groups = {"all"};
    Rng rng(seed);
    const auto point = [&] {
        const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform();
        return 2.0 * Vec3(x, y, z) - 1.0;
    };
    for (int k = 0; k < 60; ++k) {
        const Vec3 corner = point(), a = rng.uniform() * point(), b = rng.uniform() * point();
        add_quad(scene, corner, corner + a, corner + a + b, corner + b, 1, 1, 0);
    }
    scene.faces = 60;
    return scene;
}

struct Differences {
    int facets = 0, patches = 0, visible = 0;
    double farthest = 0; ///< relative difference of distances
};

Differences differences_of(const Mesh& mesh, const Camera& camera) {
    const WideBvh bvh(mesh.soup_to_trace());
    const CameraRays rays(camera, mesh, double(width) / height);
    const VisibleFacets visible(mesh, rays, {width, height, 1.0 / width, 1.0 / height}, offsets, 1);
    Differences found;
    VisibleFacets::Band band;
    for (int b = 0; b < visible.bands(); ++b) {
        visible.fill(b, band);
        for (int y = b * VisibleFacets::rows_per_band;
             y < std::min(height, (b + 1) * VisibleFacets::rows_per_band); ++y)
            for (int x = 0; x < width; ++x)
                for (unsigned s = 0; s < offsets.size(); ++s) {
                    const Vec2 place = Vec2(x, y) + offsets[s];
                    const auto seen = look(mesh, bvh, rays.ray(place.x / width, place.y / height));
                    std::uint32_t half = nothing_visible;
                    visible.visit_pixel(band, x, y, true,
                                        [&](std::uint32_t of, const Vec2&, unsigned sample,
                                            unsigned) { half = sample == s ? of : half; });
                    if (!seen || half == nothing_visible) {
                        found.facets += seen.has_value() != (half != nothing_visible);
                        continue;
                    }
                    ++found.visible;
                    const Vec3 direction = visible.direction(place);
                    const Hit hit = visible.hit_at(half, direction);
                    found.facets += hit.facet != seen->hit.facet;
                    found.patches +=
                        hit.facet == seen->hit.facet &&
                        (mesh.patch_at(hit) != seen->patch || hit.front != seen->hit.front);
                    found.farthest = std::max(
                        found.farthest,
                        std::abs(hit.t * glm::length(direction) - seen->hit.t) / seen->hit.t);
                }
    }
    return found;
}

void check_same(const Scene& scene, const MeshOptions& options, const Camera& camera) {
    const Mesh mesh(scene, options);
    const Differences found = differences_of(mesh, camera);
    CAPTURE(found.visible, options.two_sided, options.max_edge);
    CHECK(found.facets == 0);
    CHECK(found.patches == 0);
    CHECK(found.farthest < 1e-9);
}

} // namespace

TEST_CASE("filled rows show what rays see") {
    const std::vector<Camera> cameras{
        {.eye = {.1, .2, .3}, .target = {1, .9, -.4}, .vertical_fov_degrees = 100},
        {.eye = {3.3, 2.2, 1}, .target = {.1, .05, .13}, .vertical_fov_degrees = 40},
        {.eye = {.5, .52, .47}, .target = {.45, -7, .6}, .vertical_fov_degrees = 60}};
    for (const Camera& camera : cameras)
        for (const bool two_sided : {false, true})
            for (const double max_edge : {0.0, .2}) {
                check_same(room_with_block(), {.max_edge = max_edge, .two_sided = two_sided},
                           camera);
                check_same(sphere(3, 1, .5, 1), {.max_edge = max_edge, .two_sided = two_sided},
                           camera);
                for (std::uint64_t seed = 1; seed < 4; ++seed)
                    check_same(crowd(seed), {.max_edge = max_edge, .two_sided = two_sided}, camera);
            }
}

TEST_CASE("which side of a facet faces the eye does not depend on the sample") {
    const Mesh mesh(crowd(1));
    const CameraRays rays({.eye = {3, 2, 1}, .target = {0, 0, 0}}, mesh, double(width) / height);
    const VisibleFacets visible(mesh, rays, {width, height, 1.0 / width, 1.0 / height}, offsets, 1);
    VisibleFacets::Band band;
    visible.fill(visible.bands() / 2, band);
    unsigned count = 0;
    for (const std::uint32_t half : band.half)
        if (half != nothing_visible) {
            ++count;
            // The other direction is where rounding could take one along the facet.
            CHECK(visible.hit_at(half, -visible.direction({width / 2, height / 2})).front);
        }
    CHECK(count > 0);
}

TEST_CASE("nothing shows between neighbours") {
    // Through a closed sphere one would see the black outside.
    const Mesh mesh(sphere(4, 1, .5, 1));
    const Camera camera{.eye = {.01, .02, -.03}, .target = {1, 0, 0}, .vertical_fov_degrees = 120};
    const CameraRays rays(camera, mesh, 1);
    const std::array<Vec2, 1> centre{Vec2(.5)};
    const VisibleFacets visible(mesh, rays, {256, 256, 1.0 / 256, 1.0 / 256}, centre, 2);
    VisibleFacets::Band band;
    int holes = 0;
    for (int b = 0; b < visible.bands(); ++b) {
        visible.fill(b, band);
        for (const std::uint32_t half : band.half)
            holes += half == nothing_visible;
    }
    CHECK(holes == 0);
}

TEST_CASE("where nothing is in front of the camera nothing shows") {
    const Mesh mesh(crowd(1));
    const Camera camera{.eye = {0, 0, 9}, .target = {0, 0, 18}};
    CHECK(differences_of(mesh, camera).visible == 0);
}
