// OBJ files that are written again with other texture coordinates: all else stays byte for byte.
#include "io/scene_files/lit_obj.h"
#include "io/scene_files/obj.h"
#include "io/scene_files/obj_places.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <array>
#include <numeric>
#include <random>

using namespace hemilux;
using namespace hemilux::test;

namespace {

const std::string before_faces = "# odd\r\nmtllib a b.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\n"
                                 "v 0 1 0\r\nvt 0 0\r\nusemtl  x # y\r\n";
const std::string first_face = "f 1/1 2/1 \\\r\n  -2//1 4 # end\r\n";

std::string odd_file() {
    return before_faces + first_face + "vt 1 1\r\nl 1/2 2/-1\r\nf 1/2 2/-1 3";
}

/// Faces of three to six corners, some without area and some concave, among vertices that no face
/// uses. The texture coordinates of a vertex at (x, y, z) are (x, y).
std::string random_file(std::mt19937& engine) {
    const auto number_in = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine);
    };
    std::string text, vertices, faces;
    int vertex = 0;
    for (int f = number_in(2, 12); f > 0; --f) {
        for (int unused = number_in(0, 2); unused > 0; --unused, ++vertex)
            vertices += "v .5 .5 .5\nvt .5 .5\n";
        const int corners = number_in(3, 6);
        const bool flat = number_in(0, 3) == 0;
        std::string face = "f";
        for (int k = 0; k < corners; ++k, ++vertex) {
            const double turn = 6.2831853 * k / corners;
            const double radius = number_in(200, 400) / 1000.0;
            const std::string x = std::to_string(.5 + radius * std::cos(turn)),
                              y = std::to_string(flat ? .5 : .5 + radius * std::sin(turn));
            vertices += "v " + x + " " + y + " " + std::to_string(f) + "\nvt " + x + " " + y + "\n";
            const std::string number = std::to_string(vertex + 1);
            face += " " + number + "/" + number;
        }
        faces += face + "\n";
    }
    return vertices + faces;
}

} // namespace

TEST_CASE("corners of an OBJ file keep their coordinates, whatever is dropped", "[obj]") {
    std::mt19937 engine(1);
    const TemporaryFolder folder;
    std::size_t corners = 0, checked = 0;
    for (int file = 0; file < 200; ++file) {
        const std::string path = folder.write("s.obj", random_file(engine));
        ReadResult read = read_obj(path);
        std::erase_if(read.scene.facets, [&](const Facet&) { return engine() % 4 == 0; });
        if (read.scene.facets.empty())
            continue;
        const Mesh mesh = layered_mesh(std::move(read.scene), {});
        const Scene& scene = mesh.scene();
        const LitObj lit(path);
        std::vector<ChartSide> sides;
        for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
            sides.push_back({f, false});
        const PlacesOfFile found = places_in_obj(lit, mesh, sides);
        CHECK(found.without.empty());
        bool same = true;
        for (const PlacedTriangle& triangle : found.triangles) {
            const auto half = triangle.second_half ? std::array{0, 2, 3} : std::array{0, 1, 2};
            for (std::size_t k = 0; k < 3; ++k, ++corners) {
                const auto& vertex = scene.facets[triangle.facet].vertex;
                const Vec2 place(scene.vertices[vertex[static_cast<std::size_t>(half[k])]]);
                const Vec2 expected{place.x, 1 - place.y};
                same = same && glm::distance(triangle.place[k], expected) < 1e-6;
            }
        }
        CHECK(same);

        // What is written with these places as an atlas has them at the same corners.
        const LitObj again(folder.write("again.obj", text_with_atlas(lit, mesh, found.triangles)));
        for (std::size_t f = 0; f < again.faces().size(); ++f)
            for (const LitObj::Corner& corner : again.corners_of(f)) {
                const glm::vec2 of_file = lit.places()[corner.vertex];
                same = same && ++checked > 0 &&
                       glm::distance(again.places()[corner.place], of_file) < 1e-6f;
            }
        CHECK(same);
    }
    CHECK(corners > 1000);
    CHECK(checked > 1000);
}

TEST_CASE("faces of an OBJ file take new coordinates in their words alone", "[obj]") {
    const TemporaryFolder folder;
    const LitObj file(folder.write("odd.obj", odd_file()));
    CHECK(file.text() == odd_file());
    CHECK(file.has_libraries());
    REQUIRE(file.faces().size() == 2);
    const auto corners = file.corners_of(0);
    REQUIRE(corners.size() == 4);
    CHECK(corners[2].vertex == 2);
    CHECK(corners[2].place == LitObj::none);
    CHECK(corners[2].normal == 0);
    CHECK(file.corners_of(1)[1].place == 1);

    const std::vector<glm::vec2> places{{.25f, .5f}, {1, 0}};
    const std::string added = "vt 0.25 0.5\r\nvt 1 0\r\n",
                      after = " # end\r\nvt 1 1\r\nl 1/4 2/4\r\nf 1/4 2/4 3";
    std::vector<LitObj::NewPlaces> of_face(2);
    of_face[0].of_corners = {0, 1, 1, 0};
    CHECK(file.text_with(places, of_face) ==
          before_faces + added + "f 1/2 2/3 \\\r\n  3/3/1 4/2" + after);
    of_face[0] = {{}, {{{0, 0}, {1, 1}, {2, 1}}, {{0, 0}, {2, 1}, {3, 0}}}};
    CHECK(file.text_with(places, of_face) ==
          before_faces + added + "f 1/2 2/3 3/3/1\r\nf 1/2 3/3/1 4/2" + after);
}

TEST_CASE("a byte order mark stays before an OBJ file", "[obj]") {
    const TemporaryFolder folder;
    const std::string text = "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const LitObj file(folder.write("mark.obj", text));
    CHECK(file.text() == text);
    std::vector<LitObj::NewPlaces> of_face(1);
    of_face[0].of_corners = {0, 0, 0};
    CHECK(file.text_with(std::vector<glm::vec2>{{0, 1}}, of_face) ==
          "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nf 1/1 2/1 3/1\n");
}

TEST_CASE("places of an OBJ file count from above, and what lacks them is named", "[obj]") {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "s.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 .75\nvt 2 0\n"
                 "vn 0 0 1\nvn .6 0 .8\n"
                 "g whole\nf 1/1/1 2/2/2 3/3/1 4/4/1\ng bare\nf 1 2 3\ng far\nf 1/1 2/5 3/3\n");
    const ReadResult read = read_obj(path);
    const Mesh mesh(read.scene);
    const LitObj file(path);
    std::vector<ChartSide> sides;
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
        sides.push_back({f, false});
    const PlacesOfFile found = places_in_obj(file, mesh, sides);
    REQUIRE(found.triangles.size() == 3);
    CHECK(found.triangles[0].place[0] == Vec2(0, 1));
    CHECK(found.triangles[0].place[2] == Vec2(1, 0));
    CHECK(found.triangles[1].second_half);
    CHECK(found.triangles[1].place[2] == Vec2(0, .25));
    CHECK(found.without == std::vector<std::uint32_t>{1});
    CHECK(found.outside == std::vector<std::uint32_t>{2});

    const std::vector<CornerNormals> normals = normals_of_obj(file, mesh);
    CHECK(normals[0][0] == glm::vec3(0, 0, 1));
    CHECK(normals[0][1].x == Approx(.6));
    CHECK(normals[1] == CornerNormals{});
}

TEST_CASE("a face in one chart keeps its corners, one in several becomes several faces", "[obj]") {
    const TemporaryFolder folder;
    // A quad that is bent along its diagonal, so that it has two facets.
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n";
    const std::string path = folder.write("bent.obj", text);
    const ReadResult read = read_obj(path);
    const Mesh mesh(read.scene);
    REQUIRE(mesh.scene().facets.size() == 2);
    const LitObj file(path);
    std::vector<PlacedTriangle> triangles;
    for (std::uint32_t f = 0; f < 2; ++f)
        triangles.push_back({f, false, false, 7, {}});
    const auto place_by_vertex = [&] {
        for (PlacedTriangle& triangle : triangles)
            for (std::size_t k = 0; k < 3; ++k)
                triangle.place[k] = Vec2(.125 * mesh.scene().facets[triangle.facet].vertex[k], .25);
    };
    place_by_vertex();
    const std::string whole = text_with_atlas(file, mesh, triangles);
    CHECK(whole.find("\nf 1/") != std::string::npos);
    CHECK(std::count(whole.begin(), whole.end(), 'f') == 1);
    const std::string path_again = folder.write("whole.obj", whole);
    CHECK(read_obj(path_again).scene.vertices == read.scene.vertices);
    const LitObj again(path_again);
    for (const LitObj::Corner& corner : again.corners_of(0))
        CHECK(again.places()[corner.place] == glm::vec2(.125f * float(corner.vertex), .75f));

    triangles[1].chart = 8;
    const LitObj divided(folder.write("divided.obj", text_with_atlas(file, mesh, triangles)));
    REQUIRE(divided.faces().size() == 2);
    CHECK(divided.places().size() == 6);
    for (std::size_t face = 0; face < 2; ++face)
        CHECK(divided.corners_of(face).size() == 3);
}
