#include "io/scene_files/stl.h"

#include "geometry/polygon.h"
#include "io/files/error.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cstring>

using namespace hemilux;
using hemilux::test::TemporaryFolder;

namespace {

const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                          "vertex 0 1 0\nendloop\nendfacet\n";

std::string error_of(const std::string& content) {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.stl", content);
    try {
        (void)read_stl(path);
    } catch (const InputError& error) {
        return std::string(error.what()).substr(path.size() - 5);
    }
    return {};
}

/// Triangles of nine numbers, with a header that looks like a text.
std::string binary(const std::vector<float>& numbers, std::uint32_t count) {
    std::string bytes = "solid " + std::string(74, ' ') + std::string(4, '\0');
    std::memcpy(bytes.data() + 80, &count, 4);
    for (std::size_t t = 0; t < numbers.size() / 9; ++t) {
        const std::size_t begin = bytes.size() + 12;
        bytes.resize(bytes.size() + 50);
        std::memcpy(bytes.data() + begin, numbers.data() + 9 * t, 36);
    }
    return bytes;
}

const std::vector<float> two{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};

} // namespace

TEST_CASE("a text of solids is read", "[stl]") {
    const TemporaryFolder folder;
    const ReadResult result = read_stl(folder.write(
        "s.stl", "solid a part\n" + facet + "endsolid a part\nsolid\n" + facet + "endsolid\n"));
    CHECK(result.scene.faces == 2);
    CHECK(result.scene.vertices.size() == 3);
    CHECK(result.scene.groups == std::vector<std::string>{"a part", "default"});
    CHECK(result.scene.facets[1].group == 1);
    CHECK(polygon_of(result.scene.vertices, result.scene.facets[0].vertex).area_vector() ==
          Vec3(0, 0, .5));
    CHECK(result.scene.materials[0].reflectance == Vec3(.5));
    CHECK(result.face_lines == std::vector<std::uint32_t>{8, 17});
}

TEST_CASE("a text may begin with a mark or empty lines, and have capitals", "[stl]") {
    const TemporaryFolder folder;
    std::string capitals = "SOLID\n" + facet + "ENDSOLID\n";
    for (const char* const keyword : {"facet", "outer", "vertex", "endloop", "endfacet"})
        for (std::size_t at = 0; (at = capitals.find(keyword, at)) != std::string::npos; ++at)
            capitals[at] = static_cast<char>(capitals[at] - 'a' + 'A');
    for (const std::string& content : {"\xef\xbb\xbfsolid a\n" + facet + "endsolid a\n",
                                       "\r\n  \nsolid a\n" + facet + "endsolid a\n", capitals}) {
        const ReadResult result = read_stl(folder.write("s.stl", content));
        CHECK(result.scene.faces == 1);
        CHECK(result.scene.groups.size() == 1);
    }
}

TEST_CASE("a binary file is read, also one that begins like a text", "[stl]") {
    const TemporaryFolder folder;
    const ReadResult result = read_stl(folder.write("s.stl", binary(two, 2)));
    CHECK(result.scene.facets.size() == 2);
    CHECK(result.scene.vertices.size() == 4);
}

TEST_CASE("corners at one place are one vertex, also where a 0 is negative", "[stl]") {
    const TemporaryFolder folder;
    std::string other = facet;
    other.replace(other.find("vertex 0 0 0"), 12, "vertex -0 0 0");
    const ReadResult result =
        read_stl(folder.write("s.stl", "solid\n" + facet + other + "endsolid\n"));
    CHECK(result.scene.faces == 2);
    CHECK(result.scene.vertices.size() == 3);
}

TEST_CASE("triangles without area are left out", "[stl]") {
    std::vector<float> numbers = two;
    std::fill(numbers.begin(), numbers.begin() + 9, 1.f);
    const TemporaryFolder folder;
    const ReadResult result = read_stl(folder.write("s.stl", binary(numbers, 2)));
    CHECK(result.scene.faces == 2);
    CHECK(result.scene.facets.size() == 1);
    CHECK(result.degenerate_faces == 1);
    CHECK(result.warnings.size() == 1);
}

TEST_CASE("what is no STL is refused with line or byte", "[stl]") {
    CHECK(error_of("").starts_with("s.stl: expected an STL file"));
    CHECK(error_of("solid\n").starts_with("s.stl: no triangles"));
    CHECK(error_of("solid\nvertex 1 2 x\n") ==
          "s.stl:2: expected three numbers after vertex, found \"x\"");
    CHECK(error_of("solid\nfacet\nendfacet\n").starts_with("s.stl:3: expected 3 vertices"));
    CHECK(error_of("solid\nvertex 0 0 0\n").starts_with("s.stl:2: expected endfacet"));
    CHECK(error_of("solid\nface\n").starts_with("s.stl:2: expected solid, facet"));
    CHECK(error_of("solid\n" + facet + "vertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\nvertex 0 0 0\n")
              .find("found a fourth") != std::string::npos);
    CHECK(error_of(binary(two, 3)) ==
          "s.stl: byte 80: expected at most 2 triangles, as the file has 184 bytes, found 3");
    std::vector<float> numbers = two;
    numbers[4] = std::numeric_limits<float>::quiet_NaN();
    CHECK(error_of(binary(numbers, 2)) == "s.stl: byte 112: expected a finite number");
}
