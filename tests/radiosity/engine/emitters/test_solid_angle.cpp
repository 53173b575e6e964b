// Solid angles of polygons, and directions uniform over them.
#include "radiosity/engine/emitters/solid_angle.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace hemilux;

namespace {

Polygon square_at(double height, double half) {
    return {{Vec3(-half, -half, height), Vec3(half, -half, height), Vec3(half, half, height),
             Vec3(-half, half, height)}};
}

} // namespace

TEST_CASE("The side of a cube fills a sixth of the sphere around its centre") {
    const Polygon side = square_at(1, 1);
    CHECK(SeenPolygon(Vec3(0), side).solid_angle() == Approx(4 * std::numbers::pi / 6));
    CHECK(SeenPolygon(Vec3(0), side.flipped()).solid_angle() == Approx(4 * std::numbers::pi / 6));
    const Polygon half{{side.corner[0], side.corner[1], side.corner[2], side.corner[2]}};
    CHECK(SeenPolygon(Vec3(0), half).solid_angle() == Approx(4 * std::numbers::pi / 12));
}

TEST_CASE("A small solid angle is right to its last digits, and one of a touching plane") {
    const double half = 1e-7;
    CHECK(SeenPolygon(Vec3(0), square_at(2, half)).solid_angle() ==
          Approx(4 * half * half / 4).epsilon(1e-12));
    CHECK(SeenPolygon(Vec3(0), square_at(1e-9, 1)).solid_angle() ==
          Approx(2 * std::numbers::pi).epsilon(1e-6));
}

TEST_CASE("Directions are uniform in solid angle") {
    const Polygon seen{{Vec3(-1, -1, .5), Vec3(2, -1, .5), Vec3(1.5, 1, .5), Vec3(-1, .7, .5)}};
    const SeenPolygon polygon(Vec3(0), seen);
    // The mean of cos(theta) is the projected solid angle, by Lambert's sum over the edges.
    Vec3 sum(0.0), projected(0.0);
    constexpr int columns = 8000, rows = 50; // many columns, as one is divided by the diagonal
    double longest = 0;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const Vec3 direction = polygon.sample({(i + .5) / columns, (j + .5) / rows});
            longest = std::max(longest, std::abs(glm::length(direction) - 1));
            sum += direction / double(columns * rows);
        }
    CHECK(longest < 1e-12);
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 a = glm::normalize(seen.corner[k]), b = glm::normalize(seen.corner[(k + 1) % 4]);
        const Vec3 across = glm::cross(a, b);
        projected += .5 * std::atan2(glm::length(across), glm::dot(a, b)) * glm::normalize(across);
    }
    const Vec3 mean = projected / polygon.solid_angle();
    for (int c = 0; c < 3; ++c)
        CHECK(std::abs(sum[c]) == Approx(std::abs(mean[c])).margin(5e-4));
}
