// --layers: the light of each lamp in all outputs adds up to the whole; `dim` gives other powers.

#include "app/check_fails.h"
#include "app/program.h"
#include "app/report/read_report.h"
#include "app/split.h"
#include "app/statistics_file.h"
#include "io/pictures/exr_reader.h"
#include "support/catch.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

using namespace test;
using hemilux::ExrFile;
using hemilux::image_of;

namespace {

/// The room of write_room with a second lamp on the floor, of another colour.
void write_two_lamps(const Workplace& place) {
    place.write_room();
    std::string room = place.read("room.obj");
    room += "v .7 .7 .01\nv .9 .7 .01\nv .9 .9 .01\nv .7 .9 .01\ng desk\nusemtl desk\n"
            "f -4 -3 -2 -1\n";
    place.write("room.obj", room);
    place.write("room.mtl", place.read("room.mtl") + "newmtl desk\nKd .1 .1 .1\nKe 1 4 20\n");
    place.write("points.txt", ".5 .5 .01 0 0 1\n.2 .3 .01 0 0 1\n.01 .5 .5 1 0 0\n");
}

/// A table by the names of its columns.
class Table {
  public:
    explicit Table(const std::string& text) : rows_(split(text, ',')) {
        for (std::size_t k = 0; k < rows_[0].size(); ++k)
            column_[rows_[0][k]] = k;
    }
    [[nodiscard]] std::size_t rows() const { return rows_.size() - 1; }
    [[nodiscard]] bool has(const std::string& name) const { return column_.contains(name); }
    [[nodiscard]] std::string text(std::size_t row, const std::string& name) const {
        const std::size_t k = column_.at(name);
        return k < rows_[row + 1].size() ? rows_[row + 1][k] : "";
    }
    [[nodiscard]] double number(std::size_t row, const std::string& name) const {
        return std::stod(text(row, name));
    }

  private:
    std::vector<std::vector<std::string>> rows_;
    std::map<std::string, std::size_t> column_;
};

const std::string solve = "solve room.obj -q --layers lamp --error 5% ";
const std::string view = "--size 40x30 --camera .9,.5,.5,.1,.5,.3 --gather 4 ";

/// Numbers are written to the last bit, so sums are those of doubles.
void check_sum(const Table& table, const std::string& whole) {
    for (std::size_t row = 0; row < table.rows(); ++row)
        for (const std::string channel : {"r", "g", "b"})
            CHECK(table.number(row, "lamp." + channel) + table.number(row, "desk." + channel) ==
                  Approx(table.number(row, whole + "_" + channel)).epsilon(1e-12).margin(1e-12));
}

/// The green light of a row of three halves.
double green_of(const std::string& bytes, std::size_t row) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
    const std::size_t at = 6 * row + 2;
    return double(glm::unpackHalf1x16(std::uint16_t(byte(at) | byte(at + 1) << 8)));
}

double largest_difference(const hemilux::Image& a, const hemilux::Image& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.pixels.size(); ++k)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, double(std::abs(a.pixels[k][c] - b.pixels[k][c])) /
                                      std::max(double(b.pixels[k][c]), 1e-3));
    return most;
}

hemilux::Image sum(const ExrFile& file, float lamp, float desk) {
    hemilux::Image image = image_of(file, "lamp");
    const hemilux::Image other = image_of(file, "desk");
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
        image.pixels[k] = lamp * image.pixels[k] + desk * other.pixels[k];
    return image;
}

} // namespace

TEST_CASE("layers of all outputs add up to the whole, which is as without them") {
    const Workplace place;
    write_two_lamps(place);
    const std::string outputs =
        view + "-o a.exr -o a.csv --points points.txt --points-output p.csv --stats s.json ";
    REQUIRE(place.hemilux(solve + outputs).code == 0);
    const Table patches(place.read("a.csv")), points(place.read("p.csv"));
    check_sum(patches, "radiosity");
    check_sum(points, "irradiance");
    CHECK(patches.text(0, "lamp").empty());
    CHECK(patches.text(patches.rows() - 1, "lamp") == "desk");
    const ExrFile file = hemilux::read_exr(place.path("a.exr"));
    CHECK(largest_difference(sum(file, 1, 1), image_of(file, "")) < 1e-6);
    const auto json = nlohmann::json::parse(place.read("s.json"));
    REQUIRE(json["layers"].size() == 2);
    CHECK(json["layers"][1]["name"] == "desk");
    CHECK(json["layers"][1]["emitted"][2].get<double>() == Approx(.04 * 20));
    CHECK(json["layers"][0]["error"].get<double>() > 0);
    // The same run without layers: the same light.
    REQUIRE(place
                .hemilux("solve room.obj -q --error 5% " + view +
                         "-o b.csv --points points.txt --points-output q.csv")
                .code == 0);
    const Table alone(place.read("b.csv"));
    for (std::size_t row = 0; row < alone.rows(); ++row)
        CHECK(alone.text(row, "radiosity_r") == patches.text(row, "radiosity_r"));
    CHECK_FALSE(alone.has("lamp.r"));
    // Any number of threads.
    REQUIRE(place.hemilux(solve + "-t 3 " + view + "-o c.csv -o c.exr").code == 0);
    REQUIRE(place.hemilux(solve + "-t 1 " + view + "-o d.csv -o d.exr").code == 0);
    CHECK(place.read("c.csv") == place.read("d.csv"));
}

TEST_CASE("layers of light that is not gathered add up to the whole") {
    const Workplace place;
    write_two_lamps(place);
    const std::string bake = GENERATE("--bake radiosity", "--bake indirect");
    REQUIRE(place
                .hemilux(solve + view +
                         "--no-gather -o a.exr -o b.glb --lightmap 64 --divide none " + bake)
                .code == 0);
    const ExrFile picture = hemilux::read_exr(place.path("a.exr"));
    const ExrFile lightmap = hemilux::read_exr(place.path("b.lightmap.exr"));
    CHECK(largest_difference(sum(picture, 1, 1), image_of(picture, "")) < 1e-6);
    constexpr double of_a_half = 1. / 1024;
    CHECK(largest_difference(sum(lightmap, 1, 1), image_of(lightmap, "")) < of_a_half);
    // The desk's lamp is blue, and the other is not.
    const auto blue_over_red = [](const hemilux::Image& image) {
        glm::dvec3 all(0.0);
        for (const glm::vec3& pixel : image.pixels)
            all += pixel;
        return all.b / all.r;
    };
    for (const ExrFile* const file : {&picture, &lightmap})
        CHECK(blue_over_red(image_of(*file, "desk")) > 3 * blue_over_red(image_of(*file, "lamp")));
}

TEST_CASE("lamps of other rooms, of which a picture shows little, take few rays", "[slow]") {
    const Workplace place;
    const auto outcome = place.hemilux("solve " HEMILUX_SOURCE_DIR
                                       "/examples/scenes/building_6.obj -q --layers lamp "
                                       "-o lamps.exr --size 96x72 --stats s.json");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const auto statistics = nlohmann::json::parse(place.read("s.json"));
    CHECK(statistics["layers"].size() == 6);
    CHECK(statistics["rays_layers"].get<double>() < 4 * statistics["rays_learn"].get<double>());
}

TEST_CASE("dim gives lamps other powers, as a run with these does") {
    const Workplace place;
    write_two_lamps(place);
    REQUIRE(
        place.hemilux(solve + view + "-o a.exr -o a.csv --points points.txt --points-output p.csv")
            .code == 0);
    REQUIRE(place.hemilux("dim a.csv -q --power 'l*=0' --power desk=2,.5,.1 -o b.csv").code == 0);
    const Table before(place.read("a.csv")), after(place.read("b.csv"));
    for (std::size_t row = 0; row < before.rows(); ++row) {
        CHECK(after.number(row, "radiosity_r") == Approx(2 * before.number(row, "desk.r")));
        CHECK(after.number(row, "radiosity_b") == Approx(.1 * before.number(row, "desk.b")));
        CHECK(after.number(row, "stderr_g") == Approx(.5 * before.number(row, "desk.stderr.g")));
    }
    CHECK(after.number(after.rows() - 1, "emission_b") == Approx(2));
    // A run of the scene with that power finds the same, within errors.
    REQUIRE(place
                .hemilux("solve room.obj -q --divide none --error 1% --emission lamp=0 "
                         "--emission desk=2,2,2 -o c.csv")
                .code == 0);
    REQUIRE(place.hemilux("solve room.obj -q --divide none --error 1% --layers material -o d.csv")
                .code == 0);
    REQUIRE(place.hemilux("dim d.csv -q --power lamp=0 --power desk=2,.5,.1 -o e.csv").code == 0);
    const Table run(place.read("c.csv")), dimmed(place.read("e.csv"));
    double off = 0, all = 0;
    for (std::size_t row = 0; row + 1 < run.rows(); ++row) {
        off += std::pow(run.number(row, "radiosity_r") - dimmed.number(row, "radiosity_r"), 2);
        all += std::pow(run.number(row, "radiosity_r"), 2);
    }
    CHECK(std::sqrt(off / all) < .04);
    // Pictures.
    REQUIRE(place.hemilux("dim a.exr -q --power lamp=.5 --power desk=3 -o f.exr -o f.png -o f.hdr")
                .code == 0);
    const ExrFile file = hemilux::read_exr(place.path("a.exr")),
                  shown = hemilux::read_exr(place.path("f.exr"));
    CHECK(largest_difference(image_of(shown, ""), sum(file, .5f, 3)) < 1e-6);
    CHECK(place.has("f.png"));
    REQUIRE(place.hemilux("dim f.exr -q --power lamp=2 --power 'desk=.33333333' -o g.exr").code ==
            0);
    CHECK(largest_difference(image_of(hemilux::read_exr(place.path("g.exr")), ""),
                             image_of(file, "")) < 1e-5);
}

TEST_CASE("dim finds the powers for wished light at points") {
    const Workplace place;
    write_two_lamps(place);
    REQUIRE(place.hemilux(solve + "--points points.txt --points-output p.csv").code == 0);
    const Table points(place.read("p.csv"));
    std::ostringstream wishes;
    wishes << "point,wish\n";
    for (const std::size_t row : {0u, 1u, 2u}) {
        double wish = 0;
        for (const std::string channel : {".r", ".g", ".b"})
            wish += (2 * points.number(row, "lamp" + channel) +
                     .25 * points.number(row, "desk" + channel)) /
                    3;
        wishes << row << ',' << wish << '\n';
    }
    place.write("w.csv", wishes.str());
    const auto said = place.hemilux("dim p.csv --wish w.csv -o q.csv");
    REQUIRE(said.code == 0);
    const auto rows = split(said.out, ',');
    CHECK(rows[1][0] == "lamp");
    CHECK(std::stod(rows[1][1]) == Approx(2).epsilon(1e-3));
    CHECK(std::stod(rows[2][1]) == Approx(.25).epsilon(1e-3));
    CHECK(std::stod(rows[2][2]) > 0);
    CHECK(Table(place.read("q.csv")).number(1, "irradiance_g") ==
          Approx(2 * points.number(1, "lamp.g") + .25 * points.number(1, "desk.g")).epsilon(1e-3));
}

TEST_CASE("a report has the light of each lamp, and which lamp patches are of") {
    const Workplace place;
    write_two_lamps(place);
    REQUIRE(place.hemilux(solve + "--divide none --report r.html -o a.csv").code == 0);
    const std::string page = place.read("r.html");
    const auto run = nlohmann::json::parse(element_of(page, "run"));
    CHECK(run["lamps"] == nlohmann::json{"lamp", "desk"});
    const auto unit = run["lamp_unit"].get<double>();
    const Table table(place.read("a.csv"));
    for (const std::size_t lamp : {0u, 1u}) {
        const std::string bytes = from_base64(element_of(page, "lamp-" + std::to_string(lamp)));
        REQUIRE(bytes.size() == 6 * table.rows());
        const std::string name = lamp == 0 ? "lamp" : "desk";
        for (std::size_t row = 0; row < table.rows(); ++row)
            CHECK(unit * green_of(bytes, row) ==
                  Approx(table.number(row, name + ".g")).epsilon(1e-3).margin(1e-6));
    }
    const auto of = words_of(page, "lamp-of");
    CHECK(of.back() == 1);
    CHECK(of.front() == 0xffffffffu);
}

TEST_CASE("what dim and --layers cannot do is refused with a word") {
    const Workplace place;
    write_two_lamps(place);
    check_fails(place, 1, "solve room.obj --layers lamp --method progressive -o a.csv",
                "keeps the rays");
    check_fails(place, 1, "solve room.obj --layers lamps -o a.csv", "did you mean 'lamp'");
    check_fails(place, 2, "solve room.obj --layers lamp --emission '*=0' -o a.csv",
                "nothing emits light");
    REQUIRE(place.hemilux("solve room.obj -q --divide none --error 5% -o plain.csv").code == 0);
    check_fails(place, 2, "dim plain.csv -o b.csv", "solve --layers wrote");
    REQUIRE(place.hemilux(solve + "-o a.csv").code == 0);
    check_fails(place, 1, "dim a.csv --power dsk=2 -o b.csv", "did you mean 'desk'");
    check_fails(place, 1, "dim a.csv --power desk=-2 -o b.csv", "expected LAMP=FACTOR");
    check_fails(place, 1, "dim a.csv -o b.png", "as the input is a table");
    check_fails(place, 1, "dim a.csv", "expected a file to write");
    check_fails(place, 1, "dim a.csv -o a.csv", "a.csv");
    place.write("w.csv", "0,5\n");
    check_fails(place, 2, "dim a.csv --wish w.csv", "table of patches");
    REQUIRE(place.hemilux(solve + "--points points.txt --points-output p.csv").code == 0);
    place.write("w.csv", "9,5\n");
    check_fails(place, 2, "dim p.csv --wish w.csv", "expected a point from 0 to 2");
    place.write("w.csv", "1;5\n");
    check_fails(place, 2, "dim p.csv --wish w.csv", "w.csv:1: expected point,wish");
}
