// What a scene does not need: shown by info, left out by solve, recorded, and kept with --keep-all.
#include "app/program.h"
#include "app/split.h"
#include "app/statistics_file.h"
#include "support/catch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using Catch::Contains;
using namespace test;

TEST_CASE("info shows what a scene does not need") {
    const Workplace place;
    place.write_room();
    const std::string colours = place.hemilux("info room.obj").out;
    CHECK_THAT(colours, Contains("solve leaves out") && Contains("convex enclosure"));
    CHECK_THAT(colours, !Contains("grey"));
    CHECK_THAT(place.hemilux("info room.obj --reflectance '*=.5' --emission lamp=3").out,
               Contains("two of three colour channels"));
    CHECK_THAT(place.hemilux("info room.obj --reflectance '*=0'").out,
               Contains("nothing reflects"));
    CHECK_THAT(place.hemilux("info room.obj --two-sided").out, Contains("no light can reach"));
    // Without light, that is what there is to say.
    CHECK_THAT(place.hemilux("info room.obj --emission '*=0'").out,
               Contains("nothing emits light. `hemilux MODEL` lights it") &&
                   Contains("lamps by name       lamp") && !Contains("solve leaves out"));
}

namespace {

using Point = std::array<double, 3>;

/// A scene as OBJ text.
struct ObjText {
    std::string text = "mtllib scene.mtl\n";

    void quad(const std::string& material, const std::array<Point, 4>& corners) {
        for (const Point& p : corners)
            vertex(p);
        text += "usemtl " + material + "\nf -4 -3 -2 -1\n";
    }
    void vertex(const Point& p) {
        text += "v";
        for (const double x : p)
            text += " " + std::to_string(x);
        text += "\n";
    }
    /// A box seen from inside or from outside, with n x n quads of `top` above and one quad for
    /// each other side.
    void box(const Point& low, const Point& high, bool inside, const std::string& top = "white",
             int n = 1) {
        for (int axis = 0; axis < 3; ++axis)
            for (const bool up : {false, true}) {
                const bool is_top = axis == 1 && up;
                const int parts = is_top ? n : 1;
                for (int i = 0; i < parts; ++i)
                    for (int j = 0; j < parts; ++j)
                        piece(low, high, axis, up, inside, is_top ? top : "white", i, j, parts);
            }
    }
    ObjText& lit_room() {
        box({0, 0, 0}, {4, 3, 4}, true, "lamp");
        return *this;
    }
    ObjText& block(double x, double y) {
        box({x, y, 1}, {x + 1, y + 1, 2}, false);
        return *this;
    }

  private:
    void piece(const Point& low, const Point& high, int axis, bool up, bool inside,
               const std::string& material, int i, int j, int parts) {
        const auto u = std::size_t(axis + 1) % 3, v = std::size_t(axis + 2) % 3;
        const auto at = [&](int k, int l) {
            Point p = up ? high : low;
            p[u] = low[u] + (high[u] - low[u]) * k / parts;
            p[v] = low[v] + (high[v] - low[v]) * l / parts;
            return p;
        };
        std::array corners{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        if (up == inside)
            std::ranges::reverse(corners);
        quad(material, corners);
    }
};

constexpr const char* coloured = "newmtl white\nKd .7 .6 .5\nnewmtl lamp\nKd .7 .6 .5\nKe 9 8 7\n";

std::string left_out_of(const std::string& statistics) {
    const std::size_t begin = statistics.find("\"left_out\"");
    return statistics.substr(begin, statistics.find(']', begin) + 1 - begin);
}

double rays_in(const std::string& statistics) {
    return statistic(statistics, "rays_energy") + statistic(statistics, "rays_density");
}
double bytes_in(const std::string& statistics) {
    return statistic(statistics, "bytes_density") + statistic(statistics, "bytes_transport");
}

/// The light of two patch tables agrees within the standard errors, which few batches estimate.
void check_same_light(const std::string& a, const std::string& b) {
    if (a == b)
        return;
    const auto with = split(a, ','), without = split(b, ',');
    REQUIRE(with.size() == without.size());
    constexpr std::size_t area = 4, radiosity = 17, standard_error = 20;
    double difference = 0, error = 0;
    for (std::size_t row = 1; row < with.size(); ++row)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto of = [&](const auto& table, std::size_t column) {
                return std::stod(table[row][column + c]);
            };
            const double weight = std::stod(with[row][area]);
            difference += weight * std::pow(of(with, radiosity) - of(without, radiosity), 2);
            error += weight * (std::pow(of(with, standard_error), 2) +
                               std::pow(of(without, standard_error), 2));
        }
    CAPTURE(difference, error);
    CHECK(difference <= 9 * error);
}

/// What a method saves in a scene: less than with --keep-all.
enum class Saves { rays_and_bytes, rays, work_alone };

struct Needless {
    const char* name;
    ObjText scene;
    const char* materials;
    const char* why; ///< in `left_out`
    std::vector<std::pair<const char*, Saves>> methods;
    const char* arguments = "";
};

std::vector<Needless> needless_scenes() {
    using enum Saves;
    const std::vector<std::pair<const char*, Saves>> all{{"hemisphere", rays_and_bytes},
                                                         {"hemisphere-1997", rays_and_bytes},
                                                         {"matrix", rays},
                                                         {"stored-transport", work_alone}};
    const std::vector<std::pair<const char*, Saves>> linear{{"matrix", work_alone}};
    const char* const unlit = "no light can reach them";
    ObjText divided_panel;
    divided_panel.box({0, 0, 0}, {4, 3, 4}, true, "lamp", 2);
    ObjText twins = ObjText().lit_room();
    for (int k = 0; k < 2; ++k)
        twins.quad("white", {{{1, 1, 1}, {1, 1, 3}, {3, 1, 3}, {3, 1, 1}}});
    const ObjText room = ObjText().lit_room().block(1, 1);
    return {
        {"the outside of a room", room, coloured, unlit, all, "--two-sided"},
        {"a covered twin", twins, coloured, unlit, all, "--sides front"},
        {"a convex room",
         ObjText().lit_room(),
         coloured,
         "convex enclosure",
         {{"hemisphere", rays_and_bytes}, {"hemisphere-1997", rays}, {"matrix", rays}}},
        {"a convex room with a divided panel",
         divided_panel,
         coloured,
         "convex enclosure",
         {{"hemisphere", rays_and_bytes}, {"hemisphere-1997", rays}, {"matrix", rays}}},
        {"black surfaces", room, "newmtl white\nKd 0 0 0\nnewmtl lamp\nKd .5 .5 .5\nKe 9 8 7\n",
         "they neither emit nor reflect", all},
        {"only lamps and black surfaces",
         room,
         "newmtl white\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe 9 8 7\n",
         "nothing reflects that light reaches",
         {{"hemisphere", rays_and_bytes}, {"hemisphere-1997", rays_and_bytes}}},
        {"no blue light", room, "newmtl white\nKd .7 .6 .5\nnewmtl lamp\nKd .7 .6 .5\nKe 9 8 0\n",
         "nothing is emitted there", linear},
        {"a red lamp", room, "newmtl white\nKd .7 .6 .5\nnewmtl lamp\nKd .7 .6 .5\nKe 9 0 0\n",
         "nothing is emitted there", linear},
        {"all grey", room, "newmtl white\nKd .5 .5 .5\nnewmtl lamp\nKd .5 .5 .5\nKe 9 9 9\n",
         "grey", linear},
    };
}

} // namespace

TEST_CASE("What a scene does not need is left out and reported, and kept with --keep-all",
          "[slow]") {
    const Workplace place;
    for (const Needless& needless : needless_scenes()) {
        place.write("scene.obj", needless.scene.text);
        place.write("scene.mtl", needless.materials);
        for (const auto& [method, saves] : needless.methods) {
            CAPTURE(needless.name, method);
            const std::string solve = std::string("solve scene.obj --max-edge 1 --rays 64 -q ") +
                                      "--steps 4 --method " + method + " " + needless.arguments;
            REQUIRE(place.hemilux(solve + " -o a.csv --stats a.json").code == 0);
            REQUIRE(place.hemilux(solve + " --keep-all -o b.csv --stats b.json").code == 0);
            const std::string with = place.read("a.json"), all = place.read("b.json");
            CHECK_THAT(left_out_of(with), Contains(needless.why));
            CHECK(left_out_of(all) == "\"left_out\": []");
            check_same_light(place.read("a.csv"), place.read("b.csv"));
            CAPTURE(rays_in(with), rays_in(all), bytes_in(with), bytes_in(all));
            if (saves == Saves::work_alone) {
                CHECK(rays_in(with) <= rays_in(all));
            } else {
                CHECK(rays_in(with) < rays_in(all));
                CHECK((bytes_in(with) < bytes_in(all) || saves == Saves::rays));
            }
        }
    }
}

TEST_CASE("compare leaves out the same, with the same errors as --keep-all") {
    const Workplace place;
    place.write_room();
    const std::string compare =
        "compare room.obj --runs 1 --budget-rays 5000 --rays 16 "
        "--reference-error .3 --size 40x30 --methods stratified,hemisphere -q -o ";
    const auto with = place.hemilux(compare + "with"),
               all = place.hemilux(compare + "all --keep-all");
    CHECK(with.code == 0);
    CHECK(all.code == 0);
    CHECK(place.read("with/reference.csv") == place.read("all/reference.csv"));
}
