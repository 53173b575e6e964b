// Rooms behind glass: what --glass open lets in, by the share of what comes in without glass.
#include "app/program.h"
#include "app/statistics_file.h"
#include "io/results/tables.h"
#include "support/catch.h"

#include <cmath>
#include <string>

using Catch::Contains;
using hemilux::PatchTable;
using test::Workplace;

namespace {

/// A room of 4 x 3 x 4 m with a window in its wall at x = 4, and as many panes of glass in it, one
/// behind the other. The glass has these statements.
void write_room_with_window(const Workplace& place, const std::string& glass, int panes = 1) {
    place.write("room.mtl", "newmtl wall\nKd .5 .5 .5\nnewmtl glass\nKd 0 0 0\n" + glass);
    std::string obj = "mtllib room.mtl\n"
                      "v 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nv 0 3 0\nv 4 3 0\nv 4 3 4\nv 0 3 4\n"
                      "v 4 1 1\nv 4 1 3\nv 4 2.5 3\nv 4 2.5 1\n"
                      "usemtl wall\ng floor\nf 1 4 3 2\ng walls\nf 5 6 7 8\nf 1 5 8 4\nf 1 2 6 5\n"
                      "f 4 8 7 3\nf 2 3 10 9\nf 3 7 11 10\nf 7 6 12 11\nf 6 2 9 12\n"
                      "usemtl glass\ng pane\n";
    for (int k = 0; k < panes; ++k) {
        const std::string x = std::to_string(4 - .001 * k);
        for (const std::string yz : {" 1 1", " 1 3", " 2.5 3", " 2.5 1"})
            obj += "v " + x + yz + "\n";
        obj += "f -1 -2 -3 -4\n";
    }
    place.write("room.obj", obj);
}

/// The mean radiosity of the floor.
double floor_light(const Workplace& place, const std::string& options) {
    const auto run = place.hemilux("solve room.obj -q --max-edge 1 -o table.csv " + options);
    CAPTURE(options, run.err);
    REQUIRE(run.code == 0);
    const PatchTable table = hemilux::read_patch_table(place.path("table.csv").string());
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < table.radiosity.size(); ++i)
        if (std::abs(table.centre[i].y) < 1e-6) {
            sum += table.area[i] * table.radiosity[i].r;
            area += table.area[i];
        }
    return sum / area;
}

const std::string open = "--glass open --error 1% ";

} // namespace

TEST_CASE("Sky, sun and lamps light a room through panes by their share", "[slow]") {
    const Workplace place;
    for (const std::string light : {"--sky 100", "--sun -2,-1,0,800",
                                    "--light 'disc at 7,4,2 towards -5,-3,0 radius .2 watts 60'",
                                    "--light 'point at 7,4,2 watts 60'"}) {
        CAPTURE(light);
        write_room_with_window(place, "d 0\n");
        const double all = floor_light(place, open + light);
        CHECK(all > 0);
        write_room_with_window(place, "d .3\n");
        CHECK(floor_light(place, open + light) == Approx(.7 * all).epsilon(.03));
        write_room_with_window(place, "Tf .7\nillum 6\n", 2);
        CHECK(floor_light(place, open + light) == Approx(.49 * all).epsilon(.03));
        write_room_with_window(place, "");
        CHECK(floor_light(place, open + light) == Approx(0).margin(1e-6 * all));
    }
}

TEST_CASE("Methods agree on a room behind a pane", "[slow]") {
    const Workplace place;
    write_room_with_window(place, "d .3\n");
    const std::string lamp =
        "--light 'rectangle at 4.5,1.75,2 towards -1,0,0 size 2x1.5 watts 60' ";
    const double light = floor_light(place, open + lamp);
    for (const std::string method : {"matrix", "matrix --factors exact", "progressive",
                                     "monte-carlo", "hemisphere", "hierarchical"}) {
        CAPTURE(method);
        CHECK(floor_light(place, "--glass open --error 1% " + lamp + "--method " + method) ==
              Approx(light).epsilon(.03));
    }
}

TEST_CASE("Glass is solid unless it is to be open, which a warning says") {
    const Workplace place;
    write_room_with_window(place, "d .3\n");
    const std::string solve = "solve room.obj --divide none --steps 2 -o a.csv --light 'disc at "
                              "2,2.9,2 towards 0,-1,0 radius .2 watts 60' ";
    const auto solid = place.hemilux(solve);
    CHECK_THAT(solid.err, Contains("room.mtl:3: a material lets light through; it is opaque here; "
                                   "solve and bake open it by --glass open"));
    CHECK_THAT(place.read("a.csv"), Contains(",pane,"));
    const std::string before = place.read("a.csv");
    const auto as_said = place.hemilux(solve + "--glass solid");
    CHECK(place.read("a.csv") == before);
    const auto opened = place.hemilux(solve + "--glass open");
    CHECK(opened.code == 0);
    CHECK_THAT(opened.err, !Contains("lets light through"));
    CHECK_THAT(place.read("a.csv"), !Contains(",pane,"));
    CHECK(place.hemilux(solve + "--glass maybe").code == 1);
    CHECK_THAT(place.hemilux("info room.obj --glass open").out,
               Contains("glass: lets 0.7 of the light through\n"));
    CHECK_THAT(place.hemilux("info room.obj").out, Contains("but is opaque here"));
    CHECK_THAT(place.hemilux("info room.obj --json --glass open").out, Contains("\"open\": true"));
    CHECK(place.hemilux(solve + "--glass open --emission glass=1")
              .err.find("a material emits and lets light through; it is opaque here") !=
          std::string::npos);
}

TEST_CASE("The same bytes behind a pane for any number of threads, and on ranks") {
    const Workplace place;
    write_room_with_window(place, "d .3\n");
    const std::string solve = "solve room.obj -q --glass open --divide 1 --steps 3 --sky 100 ";
    REQUIRE(place.hemilux(solve + "-t 1 -o a.csv").code == 0);
    REQUIRE(place.hemilux(solve + "-t 3 -o b.csv").code == 0);
    CHECK(place.read("a.csv") == place.read("b.csv"));
}

TEST_CASE("Points behind a pane have its share of a lamp without extent, without noise") {
    const Workplace place;
    place.write("p.csv", "x,y,z,nx,ny,nz\n1,0,2,0,1,0\n");
    const auto irradiance = [&](const std::string& glass) {
        write_room_with_window(place, glass);
        REQUIRE(place
                    .hemilux("solve room.obj -q --glass open --divide none --steps 2 --reflectance "
                             "'*=0' --light 'point at 6,3.3,2 watts 60' --points p.csv "
                             "--points-output out.csv")
                    .code == 0);
        const std::string line = place.read("out.csv");
        std::size_t at = line.find('\n') + 1;
        for (int column = 0; column < 7; ++column)
            at = line.find(',', at) + 1;
        return std::stod(line.substr(at));
    };
    const double all = irradiance("d 0\n");
    CHECK(all > 0);
    CHECK(irradiance("d .3\n") == Approx(.7 * all).epsilon(1e-6));
}

TEST_CASE("The error of a picture that is seen through a pane is that of the dimmed light") {
    const Workplace place;
    write_room_with_window(place, "d .7\n");
    const auto run =
        place.hemilux("solve room.obj -q --glass open --light 'disc at 2,2.9,2 towards "
                      "0,-1,0 radius .4 watts 60' --camera 7,1.75,2,0,1.75,2,20 --size "
                      "32x24 --error 5% -o a.png --stats s.json");
    REQUIRE(run.code == 0);
    CHECK(test::statistic(place.read("s.json"), "estimated_error") < .06);
}
