// The density store: what is counted, and in how many bytes.
#include "radiosity/engine/densities/density.h"

#include "parallel/workers.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

using namespace hemilux;
using test::Model;

namespace {

DensityMap measure(const Model& model, const Hemisphere& hemisphere, double threshold) {
    Monitor monitor;
    return {model.mesh, model.bvh, hemisphere, threshold, Workers(2), monitor};
}

/// Sheets one above the other, seen from the ground.
Scene sheets(std::uint32_t n) {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"default"};
    for (std::uint32_t i = 0; i <= n; ++i) {
        const double y = i == 0 ? 0 : 1 + .001 * i, size = i == 0 ? 1 : 1000;
        test::add_quad(scene, {-size, y, -size}, {-size, y, size}, {size, y, size},
                       {size, y, -size}, 1, 1, 0);
    }
    return scene;
}

} // namespace

TEST_CASE("In a convex room every direction counts one surface") {
    const Model model(test::furnace_box(4, .5));
    const Hemisphere hemisphere(2);
    const DensityMap map = measure(model, hemisphere, .5);
    std::vector<DensityLeaf> leaves;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        map.leaves(i, leaves);
        REQUIRE(leaves.size() == 64);
        for (const DensityLeaf& leaf : leaves)
            CHECK(leaf.density == 1.0f);
    }
    CHECK(map.rays() == 41 * model.mesh.patches().size());
    CHECK(map.bytes() == map.rays());
}

TEST_CASE("Counts are those of rays traced one by one, whatever is divided") {
    const Model model(test::room_with_block());
    const Hemisphere hemisphere(2);
    for (const double threshold : {0.0, 1.0, 1.5}) {
        const DensityMap map = measure(model, hemisphere, threshold);
        std::vector<DensityCount> counts;
        std::size_t differ = 0, all = 0;
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
            map.counts(i, counts);
            all += counts.size();
            const Patch& patch = model.mesh.patches()[i];
            for (const DensityCount& count : counts) {
                const Vec3 way = density_direction(hemisphere.vertices()[count.vertex]);
                const Ray ray{.origin = patch.centre,
                              .direction = model.mesh.hemisphere_frame(i).to_world(way),
                              .from = patch.facet};
                differ += model.bvh.count(ray) != count.surfaces;
            }
        }
        CHECK(differ == 0);
        CHECK(all == map.rays());
        CHECK(all > 5 * model.mesh.patches().size());
    }
}

TEST_CASE("Nothing is kept for triangles that are not divided") {
    const Model model(test::furnace_box(4, .5));
    const std::size_t patches = model.mesh.patches().size();
    const Hemisphere hemisphere(2);
    const DensityMap map = measure(model, hemisphere, 1); // not higher than the threshold
    CHECK(map.rays() == 5 * patches);
    CHECK(map.bytes() == 5 * patches);
    CHECK(measure(model, Hemisphere(0), 0).bytes() == 5 * patches);
    CHECK(measure(model, Hemisphere(1), 0).bytes() == 13 * patches);
    CHECK(measure(model, Hemisphere(3), 0).bytes() == 145 * patches);
}

TEST_CASE("Never more than 41 bytes a patch at depth 2, whatever the threshold") {
    const Model model(test::room_with_block());
    const Hemisphere hemisphere(2);
    bool mixed = false;
    for (const double threshold : {0.0, .9, 1.1, 1.4, 1.7, 2.0, 2.5, 4.0, 300.0}) {
        const DensityMap map = measure(model, hemisphere, threshold);
        const double bytes = double(map.bytes()) / double(model.mesh.patches().size());
        CHECK(bytes <= 41);
        CHECK(bytes >= 5);
        mixed = mixed || (bytes > 6 && bytes < 40);
        // The compact store reads back what was measured: leaves cover the hemisphere, and those
        // that could have been divided were not above the threshold.
        std::vector<DensityLeaf> leaves;
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
            map.leaves(i, leaves);
            double solid_angle = 0;
            for (const DensityLeaf& leaf : leaves) {
                const auto& cell = hemisphere.cells()[leaf.cell];
                solid_angle += cell.solid_angle;
                CHECK((cell.level == 2 || leaf.density <= threshold));
            }
            CHECK(solid_angle == Approx(6.283185307179586));
        }
    }
    CHECK(mixed);
}

TEST_CASE("A leaf's density is the mean of the counts at its three vertices") {
    const Model model(test::room_with_block());
    const Hemisphere hemisphere(2);
    const DensityMap map = measure(model, hemisphere, 1.2);
    std::vector<DensityLeaf> leaves;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); i += 17) {
        map.leaves(i, leaves);
        const Frame frame = model.mesh.hemisphere_frame(i);
        for (const DensityLeaf& leaf : leaves) {
            double sum = 0;
            for (const auto v : hemisphere.cells()[leaf.cell].vertex) {
                Ray ray{model.mesh.patches()[i].centre,
                        frame.to_world(density_direction(hemisphere.vertices()[v]))};
                ray.from = model.mesh.patches()[i].facet;
                sum += model.bvh.count(ray);
            }
            CHECK(leaf.density == Approx(sum / 3).epsilon(1e-6));
        }
    }
}

TEST_CASE("Counts saturate at one byte") {
    const Model model(sheets(300));
    const Hemisphere hemisphere(0);
    const DensityMap map = measure(model, hemisphere, 0);
    std::vector<DensityLeaf> leaves;
    map.leaves(0, leaves);
    // Two vertices of each root lie near the horizon, where fewer sheets are met.
    for (const DensityLeaf& leaf : leaves)
        CHECK(leaf.density == 255.0f);
    map.leaves(300, leaves); // the topmost sheet sees nothing
    for (const DensityLeaf& leaf : leaves)
        CHECK(leaf.density == 0.0f);
}

TEST_CASE("Horizon directions are lifted, the pole is tipped, others are kept") {
    const Hemisphere hemisphere(2);
    for (const Vec3& v : hemisphere.vertices()) {
        const Vec3 d = density_direction(v);
        CHECK(glm::length(d) == Approx(1));
        CHECK(d.z >= .009);
        const double moved = glm::length(d - v);
        if (v.z > .01 && v.z < 1)
            CHECK(moved < 1e-12);
        else
            CHECK((moved > .009 && moved < .011));
    }
}
