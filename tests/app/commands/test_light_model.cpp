// `hemilux MODEL`: a model is lit where it needs it, a picture is written, nothing of the user's is
// lost.
#include "app/check_fails.h"
#include "app/picture_file.h"
#include "support/catch.h"

#include <sstream>
#include <string>

using Catch::Contains;
using test::Workplace;

namespace {

const std::string small = "--size 64x48 --error 20% ";

/// Writes a box as OBJ text, whose fronts are inside or outside.
class ObjScene {
  public:
    void box(double x0, double y0, double z0, double x1, double y1, double z1, bool inside) {
        static const int sides[6][4] = {{0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4},
                                        {1, 5, 7, 3}, {0, 1, 3, 2}, {4, 6, 7, 5}};
        for (int k = 0; k < 8; ++k)
            text_ << "v " << unit * (k & 1 ? x1 : x0) << ' ' << unit * (k & 2 ? y1 : y0) << ' '
                  << unit * (k & 4 ? z1 : z0) << '\n';
        for (const auto& side : sides) {
            text_ << "f";
            for (int i = 0; i < 4; ++i)
                text_ << ' ' << side[inside ? i : 3 - i] - 8;
            text_ << '\n';
        }
    }
    void material(const std::string& name) { text_ << "usemtl " << name << '\n'; }
    void write(const Workplace& place, const std::string& name) const {
        place.write("m.mtl", "newmtl white\nKd .7 .7 .7\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
        place.write(name, "mtllib m.mtl\nusemtl white\n" + text_.str());
    }
    double unit = 1;

  private:
    std::ostringstream text_;
};

void write_dark_room(const Workplace& place, double unit = 1) {
    ObjScene scene;
    scene.unit = unit;
    scene.box(0, 0, 0, 4, 2.5, 5, true);
    scene.box(1, 0.001, 1, 2, 1, 2, false);
    scene.write(place, "dark.obj");
}

/// Returns the options of "note: ..., so this is put in: OPTIONS"; empty where there is no such
/// line.
std::string put_in(const std::string& err) {
    const std::string before = "so this is put in: ";
    const std::size_t at = err.find(before);
    if (at == std::string::npos)
        return {};
    const std::size_t begin = at + before.size();
    return err.substr(begin, err.find('\n', begin) - begin);
}

} // namespace

TEST_CASE("hemilux MODEL writes a picture and says what to do next") {
    const Workplace place;
    place.write_room();
    const auto run = place.hemilux("room.obj " + small);
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(run.out.empty());
    CHECK(place.has("room.png"));
    CHECK_THAT(run.err, Contains("wrote room.png") && !Contains("put in"));
    const std::string last = run.err.substr(run.err.rfind('\n', run.err.size() - 2) + 1);
    CHECK_THAT(last, Contains("next: hemilux bake room.obj -o room-lit.obj") &&
                         Contains("`hemilux room.obj` with --report room-lit.html"));
    // What is written is what solve writes.
    REQUIRE(place.hemilux("room.obj -q " + small + "-o a.hdr").err.empty());
    REQUIRE(place.hemilux("solve room.obj -q " + small + "-o b.hdr").code == 0);
    CHECK(test::picture_of(place, "a.hdr") == test::picture_of(place, "b.hdr"));
}

TEST_CASE("a model without a lamp is lit, and the options that it prints give the same") {
    for (const double unit : {1.0, 1000.0, 1e-5, 1e-15, 1e15}) {
        CAPTURE(unit);
        const Workplace place;
        write_dark_room(place, unit);
        const auto run = place.hemilux("dark.obj --error 20% -o a.csv");
        CAPTURE(run.err);
        REQUIRE(run.code == 0);
        CHECK_THAT(run.err, Contains("nothing emits light"));
        const std::string options = put_in(run.err);
        CHECK_THAT(options, Contains("--light 'disc at "));
        REQUIRE(place.hemilux("solve dark.obj " + options + " --error 20% -o b.csv").code == 0);
        CHECK(place.read("a.csv") == place.read("b.csv"));
        test::check_fails(place, 2, "solve dark.obj -o c.csv", "hemilux MODEL");
    }
}

TEST_CASE("a thing is lit by sky and sun, also where z points upwards") {
    const Workplace place;
    ObjScene scene;
    scene.box(0, 0, 0, 1, 2, 1, false);
    scene.write(place, "thing.obj");
    for (const std::string up : {"y", "z"}) {
        const auto run = place.hemilux("thing.obj --error 20% -o a.csv --up " + up);
        CAPTURE(run.err);
        REQUIRE(run.code == 0);
        const std::string options = put_in(run.err);
        CHECK_THAT(options, Contains("--sky 1 --sun=") && !Contains("--light"));
        REQUIRE(place.hemilux("solve thing.obj -q " + options + " --error 20% -o b.csv").code == 0);
        CHECK(place.read("a.csv") == place.read("b.csv"));
    }
}

TEST_CASE("a lamp that lights a small place only is lamp enough") {
    const Workplace place;
    ObjScene scene;
    scene.box(-5, -0.1, -5, 5, 0, 5, false);
    scene.write(place, "ground.obj");
    const auto run = place.hemilux("ground.obj --error 20% -o a.csv --light 'spot at 0,3,0 towards "
                                   "0,-1,0 inner 20 outer 25 watts 9'");
    CAPTURE(run.err);
    CHECK(run.code == 0);
    CHECK(put_in(run.err).empty());
}

TEST_CASE("a lamp in a closed case does not light the room around it; one in the room does") {
    for (const bool is_shut : {true, false}) {
        CAPTURE(is_shut);
        const Workplace place;
        ObjScene scene;
        scene.box(0, 0, 0, 4, 2.5, 5, true);
        if (is_shut) {
            scene.box(1, 0.001, 1, 1.4, 0.5, 1.4, false);
            scene.box(1.02, 0.02, 1.02, 1.38, 0.48, 1.38, true);
        }
        scene.material("lamp");
        scene.box(1.1, 0.2, 1.1, 1.2, 0.3, 1.2, false);
        scene.write(place, "case.obj");
        const auto run = place.hemilux("case.obj --error 20% -o a.csv");
        CAPTURE(run.err);
        CHECK(run.code == 0);
        if (is_shut)
            CHECK_THAT(run.err, Contains("hardly any light reaches where one can look"));
        else
            CHECK(put_in(run.err).empty());
        // What the user's own camera shows decides where there is one.
        const std::string inside = "--camera 1.05,0.1,1.05,1.3,0.3,1.3 ";
        CHECK(put_in(place.hemilux("case.obj --error 20% -o a.csv " + inside).err).empty());
    }
}

TEST_CASE("a picture of the user's is not replaced, an earlier one of the same command is") {
    const Workplace place;
    place.write_room();
    place.write("room.png", "not even a picture");
    const auto run = place.hemilux("room.obj " + small);
    CHECK(run.code == 0);
    CHECK(place.read("room.png") == "not even a picture");
    CHECK_THAT(run.err,
               Contains("room.png is there already and stays") && Contains("wrote room.lit.png"));
    const std::string first = place.read("room.lit.png");
    CHECK(place.hemilux("room.obj " + small + "--seed 2").code == 0);
    CHECK(place.read("room.lit.png") != first);
    CHECK_FALSE(place.has("room.lit-2.png"));
    // Of another command, and of another model.
    REQUIRE(place.hemilux("solve room.obj -q " + small + "-o room.lit.png").code == 0);
    REQUIRE(place.hemilux("room.obj -q " + small).code == 0);
    CHECK(place.has("room.lit-2.png"));
}

TEST_CASE("what is asked for besides a picture is what is written") {
    const Workplace place;
    place.write_room();
    CHECK(place.hemilux("room.obj -q --stats s.json --error 20%").code == 0);
    CHECK(place.has("s.json"));
    CHECK_FALSE(place.has("room.png"));
}

TEST_CASE("a file that is no model, or is not there, is refused") {
    const Workplace place;
    place.write("notes.txt", "hello");
    test::check_fails(place, 2, "notes.txt", "expected a scene of a kind that can be read");
    test::check_fails(place, 2, "nowhere.glb", "nowhere.glb");
    CHECK_FALSE(place.has("nowhere.png"));
    place.write("empty.obj", "v 0 0 0\nf 1 1 1\n");
    test::check_fails(place, 2, "empty.obj", "none of the faces has an area");
    CHECK_FALSE(place.has("empty.png"));
}
