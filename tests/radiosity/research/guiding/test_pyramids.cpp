// The pyramidal guide: which patches lie in a pyramid, what a tree of boxes finds of them, and that
// nothing hides between three corners.
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/research/guiding/pyramids.h"

#include "parallel/workers.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/guides.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>

using namespace hemilux;
using test::Model;

namespace {

SolveOptions by_pyramids(std::uint64_t seed = 3) {
    SolveOptions options;
    set_own_options(options, GuideChoice{.guide = test::guide_named("pyramid")});
    options.seed = seed;
    return options;
}

Pyramid pyramid_of(const Mesh& mesh, std::uint32_t patch, const Hemisphere::Cell& cell) {
    Pyramid pyramid{mesh.patches()[patch].centre, cell.shape.planes()};
    for (Vec3& n : pyramid.normal)
        n = mesh.hemisphere_frame(patch).to_world(n);
    return pyramid;
}

double depth_in(const Pyramid& pyramid, const Vec3& point) {
    double least = 10;
    for (const Vec3& n : pyramid.normal)
        least = std::min(least, glm::dot(n, point - pyramid.apex));
    return least;
}

Vec3 random_point(Rng& rng) { return {rng.uniform() - .5, rng.uniform() - .5, rng.uniform() - .5}; }

/// A patch of ground under the open sky, a lamp beside it, and far above eight tiny cubes in the
/// given direction of the ground's own hemisphere, its first patch.
Scene ground_and_crowd(const Vec3& direction) {
    Scene scene;
    scene.materials = {{"lamp", Vec3(.5), Vec3(1.0)}, {"grey", Vec3(.5), Vec3(0.0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {-.1, -.1, 0}, {.1, -.1, 0}, {.1, .1, 0}, {-.1, .1, 0}, 1, 1, 0);
    test::add_quad(scene, {2, -.1, 0}, {2.2, -.1, 0}, {2.2, .1, 0}, {2, .1, 0}, 1, 1, 0);
    scene.facets.back().material = 0;
    const Frame frame = Model(scene).mesh.hemisphere_frame(0);
    for (int corner = 0; corner < 8; ++corner)
        test::add_cube(scene,
                       3.0 * frame.to_world(direction) +
                           .03 * Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1),
                       .01);
    return scene;
}

constexpr double patches_of_crowd = 48;

} // namespace

TEST_CASE("A polygon is in a pyramid if one of its points is, and only then") {
    Rng rng(7);
    int inside = 0, partly = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const SphericalTriangle triangle = test::random_triangle(rng);
        const Pyramid pyramid{random_point(rng), triangle.planes()};
        const Vec3 a = random_point(rng), u = .4 * random_point(rng), v = .4 * random_point(rng);
        Polygon polygon{{a, a + u, a + u + v, a + v}};
        if (trial % 2 == 0)
            polygon.corner = {a, a + u, a + v, a + v};
        const std::optional<Vec3> found = pyramid.point_of(polygon);
        int points = 0;
        for (int k = 0; k < 100; ++k)
            points += depth_in(pyramid, polygon.sample({rng.uniform(), rng.uniform()})) >
                      Pyramid::min_distance;
        CHECK((points == 0 || found));
        if (!found)
            continue;
        ++inside, partly += points < 100;
        CHECK(depth_in(pyramid, *found) > Pyramid::min_distance / 2);
        // It lies in the polygon's plane, and on the inner side of each edge.
        const Vec3 normal = polygon.normal();
        CHECK(std::abs(glm::dot(normal, *found - a)) < 1e-12);
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 edge = polygon.corner[(k + 1) % 4] - polygon.corner[k];
            CHECK(glm::dot(glm::cross(edge, *found - polygon.corner[k]), normal) > -1e-12);
        }
    }
    CHECK(inside > 200);
    CHECK(partly > 100);
}

TEST_CASE("A box is called outside or inside a pyramid only if all of it is") {
    Rng rng(8);
    int outside = 0, inside = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const Pyramid pyramid{random_point(rng), test::random_triangle(rng).planes()};
        Box box;
        const Vec3 at = random_point(rng);
        for (int k = 0; k < 2; ++k)
            box.include(at + .2 * random_point(rng));
        const Pyramid::Place place = pyramid.place_of(box);
        outside += place == Pyramid::Place::outside;
        inside += place == Pyramid::Place::inside;
        for (int k = 0; k < 20; ++k) {
            const Vec3 point = box.low + box.extent() * (random_point(rng) + Vec3(.5));
            const bool is_in = depth_in(pyramid, point) > Pyramid::min_distance;
            CHECK((place == Pyramid::Place::across || is_in == (place == Pyramid::Place::inside)));
        }
    }
    CHECK(outside > 500);
    CHECK(inside > 20);
}

TEST_CASE("The tree of boxes counts what all patches one by one give") {
    for (const Scene& scene :
         {test::room_with_block(), test::open_scene(), test::furnace_l_shape(.5)})
        for (const double threshold : {0.0, 6.0}) {
            const Model model(scene);
            const Hemisphere hemisphere(2);
            Monitor monitor;
            const PyramidMap map(model.mesh, hemisphere, threshold, Workers(1), monitor);
            CHECK(map.bytes() == 84 * model.mesh.patches().size());
            CHECK(map.rays() == 0);
            std::vector<DensityLeaf> leaves;
            for (std::uint32_t i = 0; i < model.mesh.patches().size(); i += 7) {
                map.leaves(i, leaves);
                double solid_angle = 0;
                for (const DensityLeaf& leaf : leaves) {
                    const Hemisphere::Cell& cell = hemisphere.cells()[leaf.cell];
                    const Pyramid pyramid = pyramid_of(model.mesh, i, cell);
                    const auto counted = static_cast<double>(
                        std::ranges::count_if(model.mesh.patches(), [&](const Patch& patch) {
                            return pyramid.point_of(patch.shape).has_value();
                        }));
                    CHECK(map.patches_in(i, leaf.cell) == Approx(counted).epsilon(.045));
                    CHECK((cell.level == 2 || counted <= threshold));
                    CHECK(double(leaf.density) ==
                          Approx(std::sqrt(map.patches_in(i, leaf.cell) * (std::numbers::pi / 32) /
                                           cell.solid_angle)));
                    solid_angle += cell.solid_angle;
                }
                CHECK(solid_angle == Approx(2 * std::numbers::pi));
            }
        }
}

TEST_CASE("What stands between three empty corners is found") {
    const Hemisphere hemisphere(2);
    const std::array octant = hemisphere.cells()[2].shape.vertices();
    const Vec3 middle = glm::normalize(octant[0] + octant[1] + octant[2]);
    const Model model(ground_and_crowd(middle));
    Monitor monitor;
    constexpr double threshold = 2;
    const auto density_at = [&](const LeafDensities& map) {
        std::vector<DensityLeaf> leaves;
        map.leaves(0, leaves);
        for (const DensityLeaf& leaf : leaves)
            if (test::contains(hemisphere.cells()[leaf.cell].shape, middle))
                return leaf;
        return DensityLeaf{};
    };
    // Rays through the corners of the octant see the sky, so it is not divided.
    const DensityMap rays(model.mesh, model.bvh, hemisphere, threshold, Workers(1), monitor);
    CHECK(density_at(rays).cell == 2);
    CHECK(density_at(rays).density == 0);
    // The pyramid has the crowd in it, down to the last level.
    const PyramidMap pyramids(model.mesh, hemisphere, threshold, Workers(1), monitor);
    CHECK(pyramids.patches_in(0, 2) == Approx(patches_of_crowd).epsilon(.045));
    const DensityLeaf found = density_at(pyramids);
    CHECK(hemisphere.cells()[found.cell].level == 2);
    CHECK(pyramids.patches_in(0, found.cell) == Approx(patches_of_crowd).epsilon(.045));
    // The other three octants hold nothing above the ground and stay whole.
    std::vector<DensityLeaf> leaves;
    pyramids.leaves(0, leaves);
    CHECK(leaves.size() == 3 + 3 + 4);

    const auto share_of_rays = [&](const Guide* guide) {
        SolveOptions options = by_pyramids();
        set_own_options(options, GuideChoice{.guide = guide});
        options.threshold = threshold;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto strategy = find_method("hemisphere")->strategy(input, hemisphere, Workers(1));
        AllocatedCells memory;
        const Allocation allocation = strategy->allocate(0, memory);
        for (std::size_t k = 0; k < allocation.cells.size(); ++k)
            if (test::contains(hemisphere.cells()[allocation.cells[k]].shape, middle))
                return allocation.rays(k) / hemisphere.cells()[allocation.cells[k]].solid_angle;
        return 0.0;
    };
    CHECK(share_of_rays(test::guide_named("pyramid")) > 3 * share_of_rays(nullptr));
}

TEST_CASE("By pyramids, shares sum to 1 and threads change nothing") {
    const Model model(test::room_with_block());
    for (const double threshold : {0.0, 5.0}) {
        SolveOptions options = by_pyramids();
        options.threshold = threshold;
        const Hemisphere hemisphere(2);
        Monitor monitor;
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto strategy = find_method("hemisphere")->strategy(input, hemisphere, Workers(1));
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
            AllocatedCells memory;
            const Allocation allocation = strategy->allocate(i, memory);
            double power = 0, rays = 0;
            for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
                const double share =
                    power_share(hemisphere, allocation.cells[k], CellArea::projected_solid_angle);
                power += share;
                rays += allocation.rays(k);
                CHECK(allocation.rays(k) > .1 * share);
            }
            CHECK(power == Approx(1).epsilon(1e-12));
            CHECK(rays == Approx(1).epsilon(1e-6));
        }
        options.threads = 1;
        const Solution one =
            test::solve(model, *find_method("hemisphere"), options, test::steps(3));
        options.threads = 4;
        const Solution four =
            test::solve(model, *find_method("hemisphere"), options, test::steps(3));
        CHECK(test::same_bits(one.radiosity, four.radiosity));
        CHECK(one.rays_density == 0);
    }
}

TEST_CASE("By pyramids, deviations from matrix are the standard errors", "[slow]") {
    for (const Scene& scene : {test::room_with_block(), test::open_scene()}) {
        const Model model(scene);
        const Solution exact = test::reference(model, .002);
        double mean = 0, squares = 0;
        constexpr int runs = 6;
        for (int run = 0; run < runs; ++run) {
            const Solution s = test::solve(model, *find_method("hemisphere"),
                                           by_pyramids(40 + std::uint64_t(run)), test::steps(64));
            const ZScores z = z_scores(model.mesh, s, exact.radiosity, exact.standard_error);
            mean += z.mean / runs;
            squares += z.rms * z.rms / runs;
        }
        CAPTURE(model.mesh.patches().size(), mean, std::sqrt(squares));
        CHECK(std::abs(mean) < .12);
        CHECK(std::sqrt(squares) == Approx(1).margin(.12));
    }
}
