// Gathered light where faces are in two states, against closed forms and the same scene without the
// other state.
#include "app/check_fails.h"
#include "app/statistics_file.h"
#include "io/files/provenance.h"
#include "io/pictures/picture_files.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"
#include "support/catch.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using namespace hemilux;
using test::Workplace;

namespace {

/// The irradiance of the red channel at the points, in their order.
std::vector<double> light_at_points(const Workplace& place, const std::string& scene,
                                    const std::string& points, const std::string& options = "") {
    place.write("points.txt", points);
    const auto outcome = place.hemilux("solve " + scene + " -q --points points.txt " +
                                       "--points-output light.csv " + options);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    std::istringstream table(place.read("light.csv"));
    std::vector<double> red;
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) {
        std::istringstream fields(line);
        std::string field;
        for (int k = 0; k < 8; ++k)
            std::getline(fields, field, ',');
        red.push_back(std::stod(field));
    }
    return red;
}

/// The factor from a point of a plane to a parallel rectangle whose corner is above the point, with
/// sides a and b over its height (Howell, configuration B-4).
double factor_of_corner(double a, double b) {
    const double x = std::sqrt(1 + a * a), y = std::sqrt(1 + b * b);
    return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * std::numbers::pi);
}

/// The same of a rectangle [x0, x1] x [z0, z1] above a point at the origin.
double factor_of(double x0, double x1, double z0, double z1, double height) {
    const auto signed_corner = [&](double x, double z) {
        const double f = factor_of_corner(std::abs(x) / height, std::abs(z) / height);
        return (x < 0) == (z < 0) ? f : -f;
    };
    return signed_corner(x1, z1) - signed_corner(x0, z1) - signed_corner(x1, z0) +
           signed_corner(x0, z0);
}

/// A ceiling of one face at a height of 2 m, of 4 x 4 m, whose texture of 4 x 1 texels glows in the
/// first; the rest of the scene is a black floor.
void write_lit_ceiling(const Workplace& place) {
    Image lit(4, 1);
    lit.pixels[0] = glm::vec3(1e6f); // white in any tone
    write_png(place.path("lit.png"), lit, Display{}, Provenance{});
    place.write("ceiling.mtl", "newmtl ceiling\nKd 0 0 0\nKe 10 10 10\nmap_Ke lit.png\n"
                               "newmtl floor\nKd 0 0 0\n");
    place.write("ceiling.obj", "mtllib ceiling.mtl\n"
                               "v -2 2 -2\nv 2 2 -2\nv 2 2 2\nv -2 2 2\n"
                               "v -2 0 -2\nv -2 0 2\nv 2 0 2\nv 2 0 -2\n"
                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                               "usemtl ceiling\nf 1/1 2/2 3/3 4/4\nusemtl floor\nf 5 6 7 8\n");
}

/// Two rooms on one floor face, closed against each other: 0.7 reflects, one lamp is 200 times as
/// bright as the other.
std::string two_rooms(double bright) {
    return "newmtl wall\nKd .7 .7 .7\nnewmtl bright\nKd 0 0 0\nKe " + std::to_string(bright) +
           " 0 0" + "\nnewmtl faint\nKd 0 0 0\nKe .5 0 0\n";
}
constexpr const char* rooms_obj =
    "mtllib rooms.mtl\nusemtl wall\n"
    "v -4 0 -2\nv 4 0 -2\nv 4 0 2\nv -4 0 2\nv -4 2.5 -2\nv 4 2.5 -2\nv 4 2.5 2\nv -4 2.5 2\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n"
    "v -.05 0 -2\nv -.05 0 2\nv -.05 2.5 2\nv -.05 2.5 -2\nf 12 11 10 9\n"
    "v .05 0 -2\nv .05 0 2\nv .05 2.5 2\nv .05 2.5 -2\nf 13 14 15 16\n"
    "usemtl bright\nv -2.3 2.4 -.3\nv -1.7 2.4 -.3\nv -1.7 2.4 .3\nv -2.3 2.4 .3\nf 17 18 19 20\n"
    "usemtl faint\nv 1.7 2.4 -.3\nv 2.3 2.4 -.3\nv 2.3 2.4 .3\nv 1.7 2.4 .3\nf 21 22 23 24\n";

} // namespace

TEST_CASE("a texture lights from where it glows") {
    const Workplace place;
    write_lit_ceiling(place);
    const std::vector<double> xs{-1.5, -.5, .5, 1.5};
    std::string points;
    for (const double x : xs)
        points += std::to_string(x) + ",0,0,0,1,0\n";
    const std::vector<double> light = light_at_points(place, "ceiling.obj", points, "--error .01");
    REQUIRE(light.size() == xs.size());
    for (std::size_t k = 0; k < xs.size(); ++k) {
        const double truth = 10 * factor_of(-2 - xs[k], -1 - xs[k], -2, 2, 2);
        CAPTURE(xs[k], light[k], truth);
        CHECK(light[k] == Approx(truth).margin(.02 * 10 * factor_of(-.5, .5, -2, 2, 2)));
    }
}

TEST_CASE("a bright room does not light its dim neighbour by a floor that both share", "[slow]") {
    const Workplace place;
    place.write("rooms.obj", rooms_obj);
    const std::string points = "2,1.2,1.9,0,0,-1\n3.9,1,0,-1,0,0\n1,0,1,0,1,0\n";
    const auto in_dim_room = [&](double bright) {
        place.write("rooms.mtl", two_rooms(bright));
        return light_at_points(place, "rooms.obj", points, "--error .02 --sides front");
    };
    const std::vector<double> beside = in_dim_room(100), alone = in_dim_room(0);
    for (std::size_t k = 0; k < alone.size(); ++k) {
        CAPTURE(k, beside[k], alone[k]);
        CHECK(beside[k] == Approx(alone[k]).epsilon(.06));
        CHECK(alone[k] > 0);
    }
}

TEST_CASE("a small picture is right within the error asked for", "[slow]") {
    // Between the points of its grid the light of the near lamp changes by more than that.
    const Workplace place;
    place.write_room();
    for (const char* const seed : {"1", "2", "3"}) {
        const auto outcome = place.hemilux(std::string("solve room.obj -q -o p.png --size 96x72 "
                                                       "--error 2% --stats s.json --seed ") +
                                           seed);
        CHECK(outcome.code == 0);
        CHECK(test::statistic(place.read("s.json"), "error_bound") <= .02);
    }
}

TEST_CASE("the error of gathered light is found as exactly as it is asked for", "[slow]") {
    const Workplace place;
    place.write_room();
    const auto relative_uncertainty = [&](const std::string& options) {
        const auto outcome = place.hemilux(
            "solve room.obj -q -o p.png --size 96x72 --error 2% --seed 4 --stats s.json" + options);
        CHECK(outcome.code == 0);
        const std::string json = place.read("s.json");
        const double error = test::statistic(json, "estimated_error");
        CHECK(error > 0);
        CHECK(error <= test::statistic(json, "error_bound"));
        CHECK(test::statistic(json, "error_bound") <= .02);
        return test::statistic(json, "estimated_error_uncertainty") / error;
    };
    CHECK(relative_uncertainty(" --error-accuracy 5%") < .075);
    CHECK(relative_uncertainty("") > .075);
}
