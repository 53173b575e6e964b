// The technique of 1997: where its vertices move, what it estimates, and how its triangles and rays
// lie.
#include "geometry/spherical_triangle.h"
#include "parallel/workers.h"
#include "radiosity/engine/densities/subdivision_1997.h"
#include "radiosity/engine/shooting/step_hook.h"
#include "radiosity/engine/shooting/strategy.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/hemisphere/edge_division.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/step_rays.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

using namespace hemilux;
using test::Model;

namespace {

double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

SphericalTriangle shape(const CountedTriangle& t) {
    return {t[0].direction, t[1].direction, t[2].direction};
}

CountedTriangle random_counted(Rng& rng) {
    CountedTriangle result;
    const auto vertices = test::random_triangle(rng).vertices();
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = {vertices[i], std::floor(20 * rng.uniform())};
    return result;
}

struct Allocator {
    SolveOptions options;
    Monitor monitor;
    Hemisphere hemisphere{0};
    std::unique_ptr<Strategy> strategy;

    explicit Allocator(const Model& model, bool literal = false,
                       const Subdivision1997Options& numbers = {}) {
        options.literal = literal;
        set_own_options(options, numbers);
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        strategy = find_method("hemisphere-1997")->strategy(input, hemisphere, Workers(1));
    }
    [[nodiscard]] StepHook& hook() const { return *strategy->step_hook(); }
    [[nodiscard]] std::optional<PrivateCell> private_cell(std::uint32_t patch,
                                                          std::uint16_t cell) const {
        return strategy->private_cells()->private_cell(patch, cell);
    }
    /// What is allocated is the same for all patches, and kept until the next step.
    [[nodiscard]] Allocation allocate(std::uint64_t step) const {
        hook().begin_step(step);
        AllocatedCells memory;
        return strategy->allocate(0, memory);
    }
};

} // namespace

TEST_CASE("Equation (1): a new point lies nearer to the end with more surfaces") {
    const Vec3 p1 = glm::normalize(Vec3(1, 2, 3)), p2 = glm::normalize(Vec3(-1, .5, .2));
    for (const auto& [ns1, ns2] : {std::pair{1., 1.}, {3., 1.}, {1., 7.}, {250., 4.}}) {
        const Vec3 p3 = point_on_arc(p1, p2, division_share(ns1, ns2));
        CAPTURE(ns1, ns2);
        CHECK(angle(p3, p1) / angle(p2, p3) == Approx(ns2 / ns1).epsilon(1e-10));
        CHECK(angle(p1, p3) + angle(p3, p2) == Approx(angle(p1, p2)).epsilon(1e-12));
        CHECK(glm::length(p3) == Approx(1).epsilon(1e-14));
    }
    // From either end it is the same point, so neighbours have no gap between them.
    const Vec3 back = point_on_arc(p2, p1, division_share(2, 5));
    CHECK(glm::length(back - point_on_arc(p1, p2, division_share(5, 2))) < 1e-15);
}

TEST_CASE("Where nothing was counted an edge is halved") {
    for (const auto& [ns1, ns2] : {std::pair{0., 0.}, {0., 9.}, {9., 0.}})
        CHECK(division_share(ns1, ns2) == .5);
    CHECK(point_on_arc({0, 0, 1}, {0, 0, 1}, .3) == Vec3(0, 0, 1));
    // Between points of the horizon lies the horizon.
    CHECK(point_on_arc({1, 0, 0}, {0, 1, 0}, .3).z == 0);
}

TEST_CASE("Estimated counts follow the printed formulas") {
    const CountedDirection a{glm::normalize(Vec3(0, .3, 1)), 2},
        b{glm::normalize(Vec3(1, 0, .5)), 6};
    const CountedDirection f = estimated_point(a, b);
    const double af = angle(a.direction, f.direction), fb = angle(f.direction, b.direction),
                 ab = angle(a.direction, b.direction);
    CHECK(af / fb == Approx(6. / 2).epsilon(1e-12));
    CHECK(f.surfaces == Approx((2 * fb + 6 * af) / ab).epsilon(1e-12));
    CHECK(f.surfaces == Approx(5)); // 2/4 + 6 * 3/4
    CHECK(estimated_point({a.direction, 0}, {b.direction, 8}).surfaces == Approx(4));
}

TEST_CASE("The four triangles fill their parent") {
    Rng rng(5);
    for (int i = 0; i < 200; ++i) {
        const CountedTriangle parent = random_counted(rng);
        double solid = 0, projected = 0;
        for (std::size_t child = 0; child < 4; ++child) {
            const SphericalTriangle t = shape(estimated_child(parent, child));
            CHECK(t.solid_angle() > 0); // the right way round
            solid += t.solid_angle();
            projected += t.projected_solid_angle();
        }
        CHECK(solid == Approx(shape(parent).solid_angle()).epsilon(1e-10));
        CHECK(projected == Approx(shape(parent).projected_solid_angle()).epsilon(1e-10));
    }
}

TEST_CASE("Each step has four times as many triangles, until plain refinement follows") {
    const Model model(test::room_with_block());
    const Allocator allocator(model);
    CHECK(allocator.allocate(0).cells.size() == 4 * 16);
    CHECK(allocator.allocate(1).cells.size() == 4 * 64);
    CHECK(allocator.allocate(2).cells.size() == 4 * 256);
    for (const std::uint64_t step : {3u, 4u, 100u}) {
        const Allocation allocation = allocator.allocate(step);
        REQUIRE(allocation.cells.size() == 1);
        CHECK(allocation.cells[0] == whole_hemisphere);
    }
    // Counted: 41 directions for each sub-patch, a float vector and a byte each.
    CHECK(allocator.strategy->density_rays() == 4 * 41 * model.mesh.patches().size());
    CHECK(allocator.strategy->density_bytes() == 13 * allocator.strategy->density_rays());
}

TEST_CASE("In a convex room all counts are equal, and edges are halved") {
    const Model model(test::furnace_box(2, .5));
    const Allocator allocator(model);
    const Hemisphere regular(3);
    for (const std::uint64_t step : {0u, 1u, 2u}) {
        allocator.hook().begin_step(step);
        const int level = static_cast<int>(step) + 1;
        const std::size_t begin = Hemisphere::cells_up_to(level - 1);
        const std::size_t cells = Hemisphere::cells_up_to(level) - begin;
        double worst = 0;
        for (std::size_t k = 0; k < 4 * cells; ++k) {
            const auto own = allocator.private_cell(7, static_cast<std::uint16_t>(k));
            REQUIRE(own);
            for (std::size_t v = 0; v < 3; ++v)
                worst = std::max(
                    worst, glm::length(own->shape.vertices()[v] -
                                       regular.cells()[begin + k % cells].shape.vertices()[v]));
        }
        CHECK(worst < 1e-6); // floats
    }
}

TEST_CASE("Rays start in sub-patches that fill the patch") {
    Scene scene = test::furnace_box(1, .5);
    test::add_quad(scene, {.2, .5, .2}, {.3, .5, .8}, {.8, .5, .7}, {.7, .5, .1}, 1, 1, 0);
    scene.vertices.push_back({.5, .9, .5});
    const auto last = static_cast<std::uint32_t>(scene.vertices.size()) - 1;
    scene.facets.push_back({{last, 0, 1, 1}, 0, 0, 0});
    const Model model(scene);
    const Allocator allocator(model);
    allocator.hook().begin_step(0);
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        const Patch& patch = model.mesh.patches()[i];
        double area = 0;
        Vec3 centre(0.0);
        for (std::uint16_t piece = 0; piece < 4; ++piece) {
            const Polygon part =
                allocator.private_cell(i, static_cast<std::uint16_t>(16 * piece))->origins;
            CHECK(glm::dot(part.normal(), patch.normal) == Approx(1));
            area += part.area();
            centre += part.area() * part.centre();
        }
        CHECK(area == Approx(patch.area));
        CHECK(glm::length(centre / area - patch.centre) < 1e-12);
    }
}

TEST_CASE("Triangles are small where surfaces are many") {
    // Solid angle and density of surfaces, seen from the floor of a room with a block in it.
    const Model model(test::room_with_block());
    const Allocator allocator(model);
    allocator.hook().begin_step(1);
    double smallest = 10, largest = 0;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        for (std::uint16_t cell = 0; cell < 256; ++cell) {
            const auto own = allocator.private_cell(i, cell);
            smallest = std::min(smallest, own->shape.solid_angle());
            largest = std::max(largest, own->shape.solid_angle());
        }
    // Midpoint division gives .07 to .14 sr.
    CHECK(smallest < .03);
    CHECK(largest > .2);
}

TEST_CASE("Steps and parts are the user's") {
    const Model model(test::room_with_block());
    for (const auto& [n, m, parts] :
         {Subdivision1997Options{1, 2, 4}, {0, 2, 1}, {3, 0, 16}, {4, 1, 1}, {0, 0, 64}}) {
        const Allocator allocator(model, false, {n, m, parts});
        CAPTURE(n, m, parts);
        for (std::uint32_t step = 0; step < n + m; ++step)
            CHECK(allocator.allocate(step).cells.size() == parts * (std::size_t{16} << (2 * step)));
        CHECK(allocator.allocate(n + m).cells.size() == 1);
        const std::size_t vertices = Hemisphere(static_cast<int>(n)).vertices().size();
        CHECK(allocator.strategy->density_rays() == parts * vertices * model.mesh.patches().size());
        CHECK(Subdivision1997::bytes_of_patch({n, m, parts}) == double(13 * parts * vertices));
    }
}

TEST_CASE("Numbers that the technique of 1997 cannot have are refused") {
    const Model model(test::furnace_box(1, .5));
    for (const Subdivision1997Options& bad : {Subdivision1997Options{6, 0, 1},
                                              {0, 7, 1},
                                              {1, 1, 0},
                                              {1, 1, 2},
                                              {1, 1, 256},
                                              {4, 2, 4},
                                              {5, 2, 1},
                                              {3, 1, 64}}) {
        CAPTURE(bad.stored_steps, bad.estimated_steps, bad.parts);
        CHECK_THROWS_AS(Subdivision1997::check(bad), std::invalid_argument);
        CHECK_THROWS_AS(Allocator(model, false, bad), std::invalid_argument);
    }
    for (const Subdivision1997Options& good :
         {Subdivision1997Options{5, 1, 1}, {0, 6, 1}, {4, 1, 4}, {2, 1, 64}})
        CHECK_NOTHROW(Subdivision1997::check(good));
}

TEST_CASE("As printed, subdivision goes on between the steps") {
    const Model model(test::room_with_block());
    const std::size_t hemispheres = 4 * model.mesh.patches().size();
    const Allocator allocator(model, true);
    const auto rays_of_step = [&](std::uint64_t step) {
        static_cast<void>(allocator.allocate(step));
        return allocator.strategy->density_rays() / hemispheres;
    };
    CHECK(rays_of_step(0) == 13);
    CHECK(rays_of_step(1) == 41);
    CHECK(rays_of_step(2) == 41); // estimated
    CHECK(rays_of_step(3) == 41);
    // A run that is resumed later counts all at once.
    const Allocator resumed(model, true);
    static_cast<void>(resumed.allocate(5));
    CHECK(resumed.strategy->density_rays() == 41 * hemispheres);
}

TEST_CASE("As printed, rays that count carry energy in the step that finds them") {
    const Model model(test::room_with_block());
    const Allocator allocator(model, true);
    for (const std::uint64_t step : {0u, 1u, 2u}) {
        const Allocation allocation = allocator.allocate(step);
        for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
            const auto own = allocator.private_cell(5, allocation.cells[k]);
            const std::uint32_t found = step == 0 ? 3 : step == 2 ? 0 : k % 4 == 3 ? 3 : 2;
            REQUIRE(own->given == found);
            // There are as many triangles as rays, or more: one ray by chance.
            CHECK(allocation.rays(k) * allocator.options.rays == Approx(1 + found));
            for (std::uint32_t g = 0; g < own->given; ++g)
                CHECK(std::ranges::any_of(own->shape.vertices(), [&](const Vec3& corner) {
                    return own->direction[g] == density_direction(corner);
                }));
        }
    }
}

namespace {

bool is_on(const Polygon& part, const Vec3& point) {
    const auto& c = part.corner;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 edge = c[(i + 1) % 4] - c[i];
        if (glm::dot(glm::cross(edge, point - c[i]), part.normal()) < 0)
            return false;
    }
    return true;
}

std::size_t rays_into(const std::vector<Ray>& rays, const Frame& frame, const PrivateCell& cell) {
    return static_cast<std::size_t>(std::ranges::count_if(rays, [&](const Ray& ray) {
        return is_on(cell.origins, ray.origin) &&
               test::contains(cell.shape, frame.to_local(ray.direction));
    }));
}

std::vector<test::StepRays> rays_of_step(const Model& model, const SolveOptions& options,
                                         std::uint32_t step) {
    test::Steps steps(model, *find_method("hemisphere-1997"), options);
    for (std::uint32_t k = 0; k < step; ++k)
        (void)steps.next();
    return steps.next();
}

} // namespace

TEST_CASE("End to end, every private cell gets its equal number of rays", "[slow]") {
    const Model model(test::black(test::room_with_block()));
    for (const auto& numbers : {Subdivision1997Options{}, {1, 2, 1}, {3, 0, 4}}) {
        SolveOptions options;
        options.rays = 40;
        options.threads = 1;
        set_own_options(options, numbers);
        const Allocator allocator(model, false, numbers);
        for (const std::uint32_t step : {1u, 2u}) {
            const Allocation allocation = allocator.allocate(step);
            const auto cells = static_cast<double>(allocation.cells.size());
            for (const test::StepRays& from : rays_of_step(model, options, step)) {
                const Frame frame = model.mesh.hemisphere_frame(from.patch);
                const double expected = double(from.rays.size()) / cells;
                std::size_t sum = 0;
                double worst = 0;
                for (const std::uint16_t cell : allocation.cells) {
                    const auto own = allocator.private_cell(from.patch, cell);
                    const std::size_t rays = rays_into(from.rays, frame, *own);
                    worst = std::max(worst, std::abs(double(rays) - expected));
                    sum += rays;
                }
                CAPTURE(step, expected);
                CHECK(from.rays.size() > 100);
                CHECK(sum == from.rays.size());
                CHECK(worst < 1 + 1 / cells); // rounded up or down
            }
        }
    }
}

TEST_CASE("End to end, as printed: rays by chance and rays that count") {
    const Model model(test::black(test::room_with_block()));
    SolveOptions options;
    options.rays = 700;
    options.threads = 1;
    options.literal = true;
    const Allocator allocator(model, true);
    for (const std::uint32_t step : {1u, 2u}) {
        const Allocation allocation = allocator.allocate(step);
        const std::size_t cells = allocation.cells.size();
        const auto by_chance =
            static_cast<std::size_t>(std::max(1.0, std::round(options.rays / double(cells))));
        for (const test::StepRays& from : rays_of_step(model, options, step)) {
            const Frame frame = model.mesh.hemisphere_frame(from.patch);
            std::size_t expected = 0;
            for (const std::uint16_t cell : allocation.cells) {
                const auto own = allocator.private_cell(from.patch, cell);
                expected += by_chance + own->given;
                CHECK(rays_into(from.rays, frame, *own) >= by_chance);
                for (std::uint32_t g = 0; g < own->given; ++g)
                    CHECK(std::ranges::any_of(from.rays, [&](const Ray& ray) {
                        return ray.origin == own->origins.centre() &&
                               ray.direction == frame.to_world(own->direction[g]);
                    }));
            }
            CAPTURE(step);
            CHECK(from.rays.size() == expected);
        }
    }
}

TEST_CASE("Guided steps are unbiased whatever the numbers, as printed they are not", "[slow]") {
    const Model model(test::room_with_block());
    const Solution exact = test::reference(model, .004);
    struct Case {
        Subdivision1997Options numbers;
        bool literal;
    };
    for (const auto& [numbers, literal] : {Case{{2, 1, 4}, false},
                                           {{1, 1, 1}, false},
                                           {{0, 1, 16}, false},
                                           {{3, 0, 1}, false},
                                           {{1, 0, 1}, true}}) {
        SolveOptions options;
        options.literal = literal;
        set_own_options(options, numbers);
        constexpr int runs = 24;
        const std::uint32_t guided = numbers.stored_steps + numbers.estimated_steps;
        const std::size_t patches = model.mesh.patches().size();
        std::vector<Vec3> sum(patches, Vec3(0.0)), squares(patches, Vec3(0.0));
        for (int run = 0; run < runs; ++run) {
            options.seed = 500 + static_cast<std::uint64_t>(run);
            const Solution s =
                test::solve(model, *find_method("hemisphere-1997"), options, test::steps(guided));
            for (std::size_t i = 0; i < patches; ++i) {
                const Vec3 off = s.radiosity[i] - exact.radiosity[i];
                sum[i] += off;
                squares[i] += off * off;
            }
        }
        double z_sum = 0, z_squares = 0, count = 0;
        for (std::size_t i = 0; i < patches; ++i)
            for (int c = 0; c < 3; ++c) {
                const double mean = sum[i][c] / runs;
                const double variance = (squares[i][c] / runs - mean * mean) / (runs - 1) +
                                        std::pow(exact.standard_error[i][c], 2);
                if (!(variance > 0))
                    continue;
                const double z = mean / std::sqrt(variance);
                z_sum += z, z_squares += z * z, ++count;
            }
        CAPTURE(literal, numbers.stored_steps, numbers.parts, z_sum / count);
        CHECK(count > 200);
        if (literal) {
            CHECK(std::sqrt(z_squares / count) > 5);
        } else {
            CHECK(std::abs(z_sum / count) < .25);
            CHECK(std::sqrt(z_squares / count) == Approx(1).margin(.15));
        }
    }
}

TEST_CASE("As printed, power goes by solid angle and every triangle gets a ray") {
    const Model model(test::room_with_block());
    const Allocator allocator(model, true);
    const Allocation allocation = allocator.allocate(2);
    double power = 0;
    for (std::size_t k = 0; k < allocation.cells.size(); ++k) {
        CHECK(allocation.rays(k) * allocator.options.rays == Approx(1));
        const auto own = allocator.private_cell(3, allocation.cells[k]);
        power += own->power;
        CHECK(own->power == Approx(own->shape.solid_angle() / (2 * std::numbers::pi) *
                                   own->origins.area() / model.mesh.patches()[3].area)
                                .margin(1e-15));
    }
    CHECK(power == Approx(1).epsilon(1e-9));
}
