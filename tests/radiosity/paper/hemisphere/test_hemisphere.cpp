// The shared table of the divided hemisphere: counts, numbering, areas; and that every triangle of
// levels 0 to 2 is sampled by the cosine.

#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/statistics.h"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace hemilux;
using namespace hemilux::test;
using std::numbers::pi;

TEST_CASE("counts of triangles and vertices per level") {
    constexpr std::array<std::size_t, 6> triangles{4, 20, 84, 340, 1364, 5460};
    constexpr std::array<std::size_t, 6> vertices{5, 13, 41, 145, 545, 2113};
    for (int depth = 0; depth <= Hemisphere::max_depth; ++depth) {
        const Hemisphere hemisphere(depth);
        CHECK(hemisphere.depth() == depth);
        CHECK(hemisphere.cells().size() == triangles[static_cast<std::size_t>(depth)]);
        CHECK(Hemisphere::cells_up_to(depth) == triangles[static_cast<std::size_t>(depth)]);
        CHECK(hemisphere.vertices().size() == vertices[static_cast<std::size_t>(depth)]);
    }
    CHECK_THROWS_AS(Hemisphere(-1), std::invalid_argument);
    CHECK_THROWS_AS(Hemisphere(6), std::invalid_argument);
}

TEST_CASE("a shallower table is the beginning of a deeper one") {
    const Hemisphere deep(4), shallow(2);
    for (std::size_t i = 0; i < shallow.vertices().size(); ++i)
        REQUIRE(shallow.vertices()[i] == deep.vertices()[i]);
    for (std::size_t i = 0; i < shallow.cells().size(); ++i)
        REQUIRE(shallow.cells()[i].vertex == deep.cells()[i].vertex);
}

TEST_CASE("children, midpoints and vertices are consistent") {
    const Hemisphere hemisphere(Hemisphere::max_depth);
    const auto& cells = hemisphere.cells();
    const auto& vertices = hemisphere.vertices();
    CHECK(vertices[0] == Vec3(0, 0, 1));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Hemisphere::Cell& cell = cells[i];
        const auto& v = cell.vertex;
        REQUIRE(i >= (cell.level == 0 ? 0 : Hemisphere::cells_up_to(cell.level - 1)));
        REQUIRE(i < Hemisphere::cells_up_to(cell.level));
        for (std::size_t k = 0; k < 3; ++k)
            REQUIRE(cell.shape.vertices()[k] == vertices[v[k]]);
        REQUIRE(glm::dot(vertices[v[0]], glm::cross(vertices[v[1]], vertices[v[2]])) > 0);
        if (cell.level == Hemisphere::max_depth) {
            REQUIRE(cell.first_child == 0);
            continue;
        }
        const auto& m = cell.midpoint;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 middle = glm::normalize(vertices[v[k]] + vertices[v[(k + 1) % 3]]);
            REQUIRE(glm::length(middle - vertices[m[k]]) < 1e-15);
        }
        const std::array<std::array<std::uint16_t, 3>, 4> expected{
            {{v[0], m[0], m[2]}, {m[0], v[1], m[1]}, {m[2], m[1], v[2]}, {m[0], m[1], m[2]}}};
        for (std::size_t k = 0; k < 4; ++k) {
            const Hemisphere::Cell& child = cells[cell.first_child + k];
            REQUIRE(child.vertex == expected[k]);
            REQUIRE(child.level == cell.level + 1);
        }
    }
    std::size_t on_horizon = 0;
    for (const Vec3& v : vertices) {
        REQUIRE(std::abs(glm::length(v) - 1) < 1e-15);
        REQUIRE((v.z == 0 || v.z > 1e-3)); // exactly on the horizon or clearly above
        on_horizon += v.z == 0;
    }
    CHECK(on_horizon == std::size_t{4} << Hemisphere::max_depth);
}

TEST_CASE("areas add up on every level") {
    const Hemisphere hemisphere(Hemisphere::max_depth);
    for (int level = 0; level <= Hemisphere::max_depth; ++level) {
        double solid = 0, projected = 0;
        for (const Hemisphere::Cell& cell : hemisphere.cells()) {
            if (cell.level != level)
                continue;
            solid += cell.solid_angle;
            projected += cell.projected_solid_angle;
        }
        CHECK(std::abs(solid - 2 * pi) < 1e-12);
        CHECK(std::abs(projected - pi) < 1e-12);
    }
}

TEST_CASE("an octant's four parts have the published areas") {
    const Hemisphere hemisphere(1);
    for (std::size_t root = 0; root < 4; ++root) {
        CHECK(hemisphere.cells()[root].solid_angle == Approx(pi / 2).margin(1e-14));
        const std::size_t first = hemisphere.cells()[root].first_child;
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(hemisphere.cells()[first + k].solid_angle == Approx(.3398).margin(5e-5));
        CHECK(hemisphere.cells()[first + 3].solid_angle == Approx(.5513).margin(5e-5));
    }
}

TEST_CASE("directions of every triangle of levels 0 to 2 follow the cosine density") {
    const Hemisphere hemisphere(2);
    const double alpha = sidak(significance, hemisphere.cells().size());
    Rng rng(52);
    for (const Hemisphere::Cell& cell : hemisphere.cells()) {
        const Histogram histogram(cell.shape);
        CHECK(chi_square(16'000, histogram.expected, [&] {
                  return histogram.cell(cell.shape.sample_rejection([&] { return rng.uniform(); }));
              }).p_value > alpha);
    }
}

TEST_CASE("directions uniform in solid angle fail in every triangle of levels 0 and 1", "[slow]") {
    const Hemisphere hemisphere(1);
    Rng rng(53);
    for (const Hemisphere::Cell& cell : hemisphere.cells()) {
        const Histogram histogram(cell.shape);
        const auto draw = [&] {
            for (;;) {
                const Vec3 d = random_upper_direction(rng);
                if (contains(cell.shape, d))
                    return histogram.cell(d);
            }
        };
        CHECK(chi_square(30000, histogram.expected, draw).p_value < 1e-6);
    }
}

TEST_CASE("The leaf at a direction holds it") {
    Rng rng(77);
    for (const int depth : {0, 1, 3, 5}) {
        const Hemisphere hemisphere(depth);
        bool all_held = true;
        for (int k = 0; k < 5000; ++k) {
            const double z = rng.uniform(), phi = 2 * pi * rng.uniform();
            const double r = std::sqrt(1 - z * z);
            const Vec3 direction(r * std::cos(phi), r * std::sin(phi), z);
            const auto& cell = hemisphere.cells()[hemisphere.leaf_at(direction)];
            all_held = all_held && cell.level == depth && contains(cell.shape, direction);
        }
        CHECK(all_held);
        for (const Vec3& vertex : hemisphere.vertices())
            CHECK(contains(hemisphere.cells()[hemisphere.leaf_at(vertex)].shape, vertex));
    }
}
