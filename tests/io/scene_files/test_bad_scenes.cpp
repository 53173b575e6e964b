// Everything that a broken or odd OBJ or MTL file may hold: refused with one message that names
// file, line and what was expected, or read and warned about once; in bounded time.

#include "io/files/error.h"
#include "io/scene_files/obj.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <sys/stat.h>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

struct Outcome {
    ReadResult read;
    std::string error;
};

Outcome outcome_of(const TemporaryFolder& folder, const std::string& content) {
    const std::string path = folder.write("s.obj", content);
    try {
        return {read_obj(path), {}};
    } catch (const InputError& error) {
        const std::string message = error.what();
        return {{}, message.substr(path.size() - 5)};
    }
}

Outcome outcome_of(const std::string& content) {
    const TemporaryFolder folder;
    return outcome_of(folder, content);
}

double area_of(const Scene& scene) {
    double area = 0;
    for (const Facet& facet : scene.facets) {
        const auto& v = facet.vertex;
        const Vec3 p = scene.vertices[v[0]];
        for (std::size_t i = 1; i < 3; ++i)
            area += .5 *
                    glm::length(glm::cross(scene.vertices[v[i]] - p, scene.vertices[v[i + 1]] - p));
    }
    return area;
}

/// A file with a face for each corner number: the line after the vertices.
std::string error_of_face(const std::string& corners) {
    return outcome_of(square + "f " + corners + "\n").error;
}

/// A polygon of n corners on a circle, each second one drawn in for a star.
std::string round_polygon(int n, double inner) {
    std::string text, face = "f";
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n, r = i % 2 == 0 ? 1 : inner;
        text += "v " + std::to_string(r * std::cos(angle)) + " " +
                std::to_string(r * std::sin(angle)) + " 0\n";
        face += " " + std::to_string(i + 1);
    }
    return text + face + "\n";
}

template <class Body>
double seconds_of(const Body& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t warnings_with(const ReadResult& read, const std::string& text) {
    std::size_t count = 0;
    for (const std::string& warning : read.warnings)
        count += warning.find(text) != std::string::npos;
    return count;
}

} // namespace

TEST_CASE("indices that name no vertex are refused with line and range", "[obj]") {
    for (const std::string corners :
         {"1 2 0", "1 2 5", "1 2 -5", "-1 -2 -2147483649", "1 2 2147483648", "1 2 4294967297",
          "1 2 18446744073709551617", "1 2 -9223372036854775809", "0/0/0 1 2", "1/2/3/4 1 2"}) {
        const std::string error = error_of_face(corners);
        CAPTURE(corners, error);
        CHECK(error.starts_with("s.obj:5: expected a vertex"));
    }
}

TEST_CASE("faces of 0 to 2 corners, repeated and collinear vertices", "[obj]") {
    CHECK(error_of_face("").starts_with("s.obj:5: expected three or more vertices"));
    const Outcome some = outcome_of(square + "f 1\nf 1 2\nf 1 1 1\nf 1 2 1\nf 1 1 2 2 3 3 4 4\n");
    CHECK(some.error.empty());
    CHECK(some.read.degenerate_faces == 4);
    CHECK(some.read.scene.faces == 5);
    CHECK(area_of(some.read.scene) == Approx(1));
    CHECK(some.read.warnings.size() == 2);
    const Outcome line = outcome_of("v 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\n");
    CHECK(line.error == "s.obj: none of the faces has an area");
}

TEST_CASE("polygons of any number of corners are read in time", "[obj]") {
    for (const int corners : {1000, 20000}) {
        for (const double inner : {1.0, .5}) { // convex, and a star
            CAPTURE(corners, inner);
            Outcome star;
            CHECK(seconds_of([&] { star = outcome_of(round_polygon(corners, inner)); }) < 10);
            CHECK(star.error.empty());
            CHECK(area_of(star.read.scene) ==
                  Approx(corners / 2.0 * inner * std::sin(2 * std::numbers::pi / corners))
                      .epsilon(1e-3));
        }
    }
}

TEST_CASE("faces that cross themselves are read and said once", "[obj]") {
    const Outcome bow = outcome_of(square + "v 3 0 0\nv 4 0 0\nv 3 1 0\nv 4 1.5 0\n"
                                            "f 1 2 3 4\nf 5 6 7 8\nf 5 6 7 8\n");
    CHECK(bow.error.empty());
    CHECK(warnings_with(bow.read, "cross") == 1);
}

TEST_CASE("libraries that are missing, empty, a folder, a pipe or the scene itself", "[obj]") {
    const std::string face = square + "usemtl a\nf 1 2 3 4\n";
    const TemporaryFolder folder;
    folder.write("empty.mtl", "");
    folder.write("loop.mtl", "mtllib loop.mtl\nmtllib s.obj\nnewmtl a\nKd .25 .25 .25\n");
    std::filesystem::create_directory(folder.path("folder.mtl"));
    REQUIRE(::mkfifo(folder.path("pipe.mtl").c_str(), 0600) == 0);
    for (const char* name : {"none.mtl", "empty.mtl", "folder.mtl", "pipe.mtl", "s.obj", "",
                             "loop.mtl", ".", "/dev/zero", "/dev/stdin"}) {
        CAPTURE(name);
        Outcome outcome;
        CHECK(seconds_of([&] {
                  outcome = outcome_of(folder, "mtllib " + std::string(name) + "\n" + face);
              }) < 2);
        CHECK(outcome.error.empty());
        REQUIRE(outcome.read.scene.materials.size() >= 1);
        const bool has_it = std::string(name) == "loop.mtl";
        CHECK(outcome.read.scene.materials[0].reflectance.r == (has_it ? .25 : .5));
        CHECK(outcome.read.warnings.empty() == has_it);
    }
    std::string missing;
    for (int i = 0; i < 20000; ++i)
        missing += "mtllib none.mtl\n";
    const Outcome many = outcome_of(folder, missing + face);
    CHECK(warnings_with(many.read, "not found") == 1);
    const Outcome long_name =
        outcome_of(folder, "mtllib " + std::string(2000000, 'x') + "\n" + face);
    REQUIRE(long_name.read.warnings.size() == 2);
    CHECK(long_name.read.warnings[0].size() < 300);
}

TEST_CASE("materials defined many times are said once", "[obj]") {
    const TemporaryFolder folder;
    std::string library;
    for (int i = 0; i < 20000; ++i)
        library += "newmtl a\nKd .25 .25 .25\n";
    folder.write("a.mtl", library);
    const Outcome outcome = outcome_of(folder, "mtllib a.mtl\n" + square + "usemtl a\nf 1 2 3 4\n");
    CHECK(warnings_with(outcome.read, "is defined") == 1);
}

TEST_CASE("damaged libraries name themselves and the line", "[mtl]") {
    const TemporaryFolder folder;
    for (const std::string bad : {"Kd .5 .5 x", "Kd 0x1 0 0", "Ke 1D3 1 1", "Kd ,5 ,5 ,5",
                                  "Kd -1 0 0", "Ke inf 0 0", "Ke nan"}) {
        folder.write("a.mtl", "newmtl a\r\rKd .1 .1 .1\r" + bad + "\r");
        CHECK_THROWS_WITH(read_obj(folder.write("s.obj", "mtllib a.mtl\n" + square + "f 1 2 3\n")),
                          Catch::Contains("a.mtl:4: expected"));
    }
    for (const std::string& bytes :
         {std::string("\xff\xfen\0e\0", 6), std::string("newmtl\0a", 8)}) {
        folder.write("a.mtl", bytes);
        CHECK_THROWS_WITH(read_obj(folder.path("s.obj")), Catch::Contains("a.mtl"));
    }
}

TEST_CASE("long lines, odd names and odd line ends are read", "[obj]") {
    const std::string name = "M\xc3\xb6"
                             "bel \xff 7";
    const Outcome odd = outcome_of("\xef\xbb\xbfg " + name + "\r" + square + "usemtl " + name +
                                   "\rf 1 2 3 4\r#" + std::string(2000000, 'x') + "\r");
    CHECK(odd.error.empty());
    CHECK(odd.read.scene.materials.at(0).name == name);
    CHECK(odd.read.scene.groups.at(0) == name);
    for (const char* keyword : {"v ", "f ", "g ", "usemtl ", "mtllib ", "vn ", "unknown "}) {
        CAPTURE(keyword);
        Outcome outcome;
        CHECK(seconds_of([&] {
                  outcome =
                      outcome_of(square + "f 1 2 3\n" + keyword + std::string(2000000, '1') + "\n");
              }) < 2);
        CHECK(outcome.error.size() < 300);
    }
}

TEST_CASE("free-form curves, points and lines are left out and said once", "[obj]") {
    const Outcome outcome =
        outcome_of(square + "p 1 2\nl 1 2 3\np 4\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3\n"
                            "parm u 0 1\nend\nsurf 0 1 0 1 1\nf 1 2 3 4\n");
    CHECK(outcome.error.empty());
    CHECK(outcome.read.warnings.size() == 2);
    CHECK(outcome_of(square + "l 1 2\np 3\n").error.find("no faces") != std::string::npos);
}

TEST_CASE("coordinates at the ends of what doubles hold are read or refused", "[obj]") {
    CHECK(outcome_of("v 0 0 0\nv 1e99 0 0\nv 0 1e99 0\nf 1 2 3\n").error.empty());
    CHECK(outcome_of("v 0 0 0\nv 1e-320 0 0\nv 0 1e-320 0\nf 1 2 3\n").error ==
          "s.obj: none of the faces has an area");
    for (const char* number : {"1e101", "1e300", "-1e999999999999999999", "NaN", "Infinity",
                               "1#INF", "0x1p3", "1d5", "1,000", "1'000", "\xd9\xa1"}) {
        CAPTURE(number);
        CHECK(outcome_of("v " + std::string(number) + " 0 0\n")
                  .error.starts_with("s.obj:1: expected "));
    }
}
