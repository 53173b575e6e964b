// The sunlit fraction of patches: closed forms, plain rays, errors.
#include "geometry/polygon_sampler.h"
#include "radiosity/engine/factors/points/sunlit.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "support/bare_scene.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;

namespace {

Scene ground() {
    Scene scene = test::bare_scene();
    test::add_quad(scene, {0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}, 1, 1, 0);
    return scene;
}

std::vector<OpenShare> lit(const test::Model& model, const Vec3& sun,
                           const SunlitOptions& options = {}) {
    Monitor monitor;
    return sunlit_patches(glm::normalize(sun), model.mesh, model.bvh, options, Workers(2), monitor);
}

bool is_exactly(const OpenShare& share, double value) {
    return std::abs(share.factor - value) < 1e-12 && share.standard_error == 0;
}

} // namespace

TEST_CASE("A plate throws its own shape, a block a shadow by its height") {
    Scene scene = ground();
    test::add_quad(scene, {2, 3, 2}, {4, 3, 2}, {4, 6, 2}, {2, 6, 2}, 1, 1, 0);
    const test::Model plate(std::move(scene));
    CHECK(is_exactly(lit(plate, {0, 0, 1})[0], 1 - 6. / 64));
    CHECK(is_exactly(lit(plate, {0, 0, 1})[1], 1));
    CHECK(is_exactly(lit(plate, {1, 0, 2})[0], 1 - 6. / 64)); // moved by 1
    CHECK(is_exactly(lit(plate, {3, 0, 2})[0], 1 - 3. / 64)); // half of it falls beside
    CHECK(is_exactly(lit(plate, {0, 0, -1})[0], 0));
    CHECK(is_exactly(lit(plate, {0, 0, -1})[1], 0)); // its back is no surface
    CHECK(is_exactly(lit(plate, {1, 0, 0})[0], 0));  // edge-on

    Scene with_block = ground();
    test::add_block(with_block, {3, 3, 0}, {4, 5, 1.5});
    const test::Model block(std::move(with_block));
    // The sun in the east at 45 degrees: 1.5 x 2 of shadow, and 1 x 2 under the block.
    CHECK(is_exactly(lit(block, {1, 0, 1})[0], 1 - 5. / 64));
    int fully = 0, dark = 0;
    const std::vector<OpenShare> all = lit(block, {1, 0, 1});
    for (std::size_t side = 1; side < all.size(); ++side) {
        fully += is_exactly(all[side], 1);
        dark += is_exactly(all[side], 0);
    }
    CHECK((fully == 2 && dark == 4)); // roof and east; the north and the south are edge-on
}

TEST_CASE("A patch that one facet hides, or two together, is dark for certain") {
    Scene scene = ground();
    test::add_quad(scene, {-1, -1, 1}, {9, -1, 1}, {9, 4, 1}, {-1, 4, 1}, 1, 1, 0);
    const test::Model half(scene);
    CHECK(is_exactly(lit(half, {0, 0, 1})[0], .5));
    test::add_quad(scene, {-1, 4, 1}, {9, 4, 1}, {9, 9, 1}, {-1, 9, 1}, 1, 1, 0);
    const test::Model whole(std::move(scene));
    CHECK(is_exactly(lit(whole, {0, 0, 1})[0], 0));
    CHECK(is_exactly(lit(whole, {.1, .1, 1})[0], 0));
}

TEST_CASE("Sunlit fractions among blocks are those of plain rays") {
    Scene scene = ground();
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3 low(.8 + 2.5 * i, .7 + 2.6 * k, 0);
            test::add_block(scene, low, low + Vec3(1.3, 1.4, .7 + .6 * ((i + 2 * k) % 4)));
        }
    const test::Model model(std::move(scene));
    constexpr int rays = 20'000;
    int partly = 0;
    for (const Vec3& towards :
         {Vec3(1, 2, 1), Vec3(-2, .3, 1), Vec3(.2, -.1, 1), Vec3(-1, -1, .2)}) {
        const Vec3 sun = glm::normalize(towards);
        const std::vector<OpenShare> shares = lit(model, sun);
        Rng random(9);
        for (std::uint32_t i = 0; i < shares.size(); ++i) {
            const Patch& patch = model.mesh.patches()[i];
            int arrived = 0;
            const PolygonSampler points(patch.shape);
            for (int k = 0; k < rays && glm::dot(patch.normal, sun) > 0; ++k) {
                const double u = random.uniform(), v = random.uniform();
                arrived += !model.bvh.occluded(
                    {.origin = points.sample({u, v}), .direction = sun, .from = patch.facet});
            }
            const double p = shares[i].factor;
            CHECK(std::abs(double(arrived) / rays - p) < 5 * std::sqrt(p * (1 - p) / rays) + 1e-9);
            CHECK(shares[i].standard_error == 0);
            partly += p > 0 && p < 1;
        }
    }
    CHECK(partly > 20);
}

TEST_CASE("Where too many shadows fall, rays find the fraction within their errors") {
    Scene scene = ground();
    for (int i = 0; i < 20; ++i)
        for (int k = 0; k < 20; ++k)
            test::add_quad(scene, {.4 * i, .4 * k, 1}, {.4 * i + .3, .4 * k, 1},
                           {.4 * i + .3, .4 * k + .3, 1}, {.4 * i, .4 * k + .3, 1}, 1, 1, 0);
    const test::Model model(std::move(scene));
    const double truth = 1 - 400 * .09 / 64;
    double squares = 0;
    constexpr int seeds = 30;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const OpenShare share = lit(model, {0, 0, 1}, {.seed = seed})[0];
        const double z = (share.factor - truth) / share.standard_error;
        CHECK(std::abs(z) < 4);
        CHECK((share.standard_error > 0 && share.standard_error <= .01));
        squares += z * z;
    }
    CHECK(squares / seeds < 1.5);
}

TEST_CASE("A point is in the sun or in the shade, and only from its front") {
    Scene scene = ground();
    test::add_quad(scene, {2, 2, 1}, {6, 2, 1}, {6, 6, 1}, {2, 6, 1}, 1, 1, 0);
    const test::Model model(std::move(scene));
    const auto at = [&](const Vec3& world, const Vec3& normal) {
        return FactorPoint{model.mesh.frame().to_local(world), normal, none};
    };
    CHECK_FALSE(is_sunlit(at({4, 4, .5}, {0, 0, 1}), {0, 0, 1}, model.bvh));
    CHECK(is_sunlit(at({1, 4, .5}, {0, 0, 1}), {0, 0, 1}, model.bvh));
    CHECK_FALSE(is_sunlit(at({1, 4, .5}, {0, 0, -1}), {0, 0, 1}, model.bvh));
    CHECK_FALSE(is_sunlit(at({1, 4, .5}, {1, 0, 0}), {0, 0, 1}, model.bvh));
}
