// A corner of a file has one name from reading to writing, whatever is dropped, turned or layered
// in between: random glTF files in which texture coordinates and normals follow from the place.

#include "io/files/error.h"
#include "io/gltf/gltf.h"
#include "io/gltf/gltf_text.h"
#include "io/gltf/lit_source.h"
#include "radiosity/light/layers/layered_mesh.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

using Engine = std::mt19937;

int number_in(Engine& engine, int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(engine);
}

/// A primitive of loose triangles, a strip or a fan, with or without indices, in which many
/// triangles have no area. A vertex at (x, y, z) has the texture coordinates (x, y) and a normal
/// along (x, y, 1).
class PrimitiveText {
  public:
    PrimitiveText(Engine& engine, std::vector<std::string>& contents, std::string& accessors)
        : contents_(contents), accessors_(accessors) {
        const int vertices = 3 * number_in(engine, 2, 8);
        std::vector<float> places, normals, coordinates;
        const auto random = [&] { return float(number_in(engine, 1, 4095)) / 4096.0f; };
        for (int v = 0; v < vertices; ++v) {
            const bool again = v > 0 && number_in(engine, 0, 3) == 0; // the vertex before
            const float x = again ? places[places.size() - 3] : random(),
                        y = again ? places[places.size() - 2] : random(),
                        z = again ? places[places.size() - 1] : random();
            places.insert(places.end(), {x, y, z});
            coordinates.insert(coordinates.end(), {x, y});
            const float length = std::sqrt(x * x + y * y + 1);
            normals.insert(normals.end(), {x / length, y / length, 1 / length});
        }
        const std::string place = add(bytes_of(places), "VEC3", 5126, vertices),
                          normal = add(bytes_of(normals), "VEC3", 5126, vertices),
                          coordinate = add(bytes_of(coordinates), "VEC2", 5126, vertices);
        text_ = R"({"attributes":{"POSITION":)" + place + R"(,"NORMAL":)" + normal +
                R"(,"TEXCOORD_0":)" + coordinate + R"(,"TEXCOORD_1":)" + coordinate + "}";
        if (number_in(engine, 0, 1) == 1) {
            std::vector<std::uint16_t> indices;
            for (int k = 3 * number_in(engine, 1, 8); k > 0; --k)
                indices.push_back(static_cast<std::uint16_t>(number_in(engine, 0, vertices - 1)));
            text_ += R"(,"indices":)" +
                     add(bytes_of(indices), "SCALAR", 5123, static_cast<int>(indices.size()));
        }
        text_ += R"(,"mode":)" + std::to_string(number_in(engine, 4, 6)) + "}";
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string add(const std::string& bytes, const std::string& type, int component, int count) {
        accessors_ += std::string(accessors_.empty() ? "" : ",") + R"({"bufferView":)" +
                      std::to_string(contents_.size()) + R"(,"componentType":)" +
                      std::to_string(component) + R"(,"count":)" + std::to_string(count) +
                      R"(,"type":")" + type + R"("})";
        contents_.push_back(bytes);
        return std::to_string(contents_.size() - 1);
    }

    std::vector<std::string>& contents_;
    std::string& accessors_;
    std::string text_;
};

/// Some meshes of some primitives, shown by nodes that move or mirror them along z alone.
std::string random_file(Engine& engine) {
    std::vector<std::string> contents;
    std::string accessors, meshes, nodes;
    const int count = number_in(engine, 1, 3);
    for (int m = 0; m < count; ++m) {
        std::string primitives;
        for (int p = number_in(engine, 1, 3); p > 0; --p)
            primitives += PrimitiveText(engine, contents, accessors).text() + (p > 1 ? "," : "");
        meshes += std::string(m > 0 ? "," : "") + R"({"primitives":[)" + primitives + "]}";
    }
    const int shown = number_in(engine, 1, 4);
    for (int n = 0; n < shown; ++n)
        nodes += std::string(n > 0 ? "," : "") + R"({"mesh":)" +
                 std::to_string(number_in(engine, 0, count - 1)) + R"(,"translation":[0,0,)" +
                 std::to_string(10 * n) + "]" +
                 (number_in(engine, 0, 1) == 1 ? R"(,"scale":[1,1,-1]})" : "}");
    return gltf_text(contents, R"("accessors":[)" + accessors + R"(],"meshes":[)" + meshes +
                                   R"(],"nodes":[)" + nodes + "]");
}

/// What becomes of a scene before it is written again: facets are taken out, as panes of glass are,
/// and turned around.
void change(Scene& scene, Engine& engine) {
    std::erase_if(scene.facets, [&](const Facet&) { return number_in(engine, 0, 3) == 0; });
    for (Facet& facet : scene.facets)
        if (number_in(engine, 0, 2) == 0)
            facet.vertex = {facet.vertex[0], facet.vertex[2], facet.vertex[1], facet.vertex[1]};
}

/// Reads a random file and changes it; files in which nothing has an area are refused, and others
/// are made.
ReadResult changed_file(const TemporaryFolder& folder, Engine& engine) {
    for (;;) {
        const std::string path = folder.write("s.gltf", random_file(engine));
        try {
            ReadResult read = read_gltf(path);
            change(read.scene, engine);
            if (!read.scene.facets.empty())
                return read;
        } catch (const InputError& error) {
            REQUIRE_THAT(error.what(), Catch::Contains("has an area"));
        }
    }
}

/// A random file that was read, changed and divided, and is opened again to be written.
struct Reopened {
    Reopened(const TemporaryFolder& folder, Engine& engine)
        : read(changed_file(folder, engine)), mesh(layered_mesh(std::move(read.scene), {})),
          source(folder.path("s.gltf"), {}, Outside::reported, read.origins),
          all(read.origins.size()) {
        std::iota(all.begin(), all.end(), std::size_t{0});
    }
    ReadResult read; ///< but for its scene, which the mesh has
    Mesh mesh;
    gltf::LitSource source;
    std::vector<std::size_t> all; ///< numbers of its origins
};

std::vector<ChartSide> fronts(const Mesh& mesh) {
    std::vector<ChartSide> sides;
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
        sides.push_back({f, false});
    return sides;
}

/// The place of a facet's corner in the coordinates of these files.
Vec2 place_of_corner(const Mesh& mesh, std::uint32_t facet, std::size_t corner) {
    const Scene& scene = mesh.scene();
    return {scene.vertices[scene.facets[facet].vertex[corner]]};
}

} // namespace

TEST_CASE("a corner keeps its texture coordinates and its normal, whatever is dropped", "[gltf]") {
    Engine engine(1);
    const TemporaryFolder folder;
    std::size_t corners = 0;
    for (int file = 0; file < 300; ++file) {
        Reopened opened(folder, engine);
        const Mesh& mesh = opened.mesh;
        const std::vector<ChartSide> sides = fronts(mesh);
        bool same = true;

        PlacesOfFile found = gltf::places_in_set(opened.source, mesh, sides, 1, opened.all);
        for (const PlacedTriangle& triangle : found.triangles)
            for (std::size_t k = 0; k < 3; ++k, ++corners)
                same = same && triangle.place[k] == place_of_corner(mesh, triangle.facet, k);
        CHECK(same);

        const std::vector<CornerNormals> normals = gltf::normals_of_file(opened.source, mesh);
        for (std::uint32_t f = 0; f < normals.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 slope = Vec2(normals[f][k]) / std::abs(double(normals[f][k].z));
                const Vec2 place = place_of_corner(mesh, f, k);
                same = same &&
                       std::min(glm::distance(slope, place), glm::distance(slope, -place)) < 1e-5;
            }
        CHECK(same);
    }
    CHECK(corners > 1000);
}

TEST_CASE("coordinates of an atlas reach the corners that they were made for", "[gltf]") {
    Engine engine(2);
    const TemporaryFolder folder;
    std::size_t corners = 0;
    for (int file = 0; file < 300; ++file) {
        Reopened opened(folder, engine);
        const Mesh& mesh = opened.mesh;
        std::vector<PlacedTriangle> placed;
        for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f) {
            placed.push_back({f, false, false, f, {}}); // a chart for each facet
            for (std::size_t k = 0; k < 3; ++k)
                placed.back().place[k] = place_of_corner(mesh, f, k);
        }
        const std::vector<std::uint32_t> by_face = gltf::facets_by_face(mesh);
        bool same = true;
        for (const gltf::AtlasCoordinates& atlas :
             gltf::atlas_coordinates(opened.source, mesh, placed, opened.all)) {
            const PrimitiveOrigin& origin = opened.read.origins[atlas.origin];
            const gltf::Triangles triangles = opened.source.triangles_of(origin, 1);
            for (std::uint32_t t = 0; t < origin.faces; ++t)
                for (std::size_t k = 0; by_face[origin.first_face + t] != none && k < 3; ++k)
                    same = same && ++corners > 0 &&
                           atlas.places[atlas.corners[t][k]] ==
                               triangles.texcoords[0][triangles.corners[t][k]];
        }
        CHECK(same);
    }
    CHECK(corners > 1000);
}
