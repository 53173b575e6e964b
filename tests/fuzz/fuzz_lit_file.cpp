// Any bytes as a glTF file that gets a lightmap, as by `bake`: refused by InputError, or written as
// a file that is read again as the same triangles.

#include "fuzz/input_file.h"
#include "fuzz/whole_scene.h"
#include "io/gltf/gltf.h"
#include "io/gltf/lit_file.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <vector>

namespace {

using namespace hemilux;

struct TooLarge {};

void guard(double bytes) {
    constexpr double most = 64e6;
    if (bytes > most)
        throw TooLarge();
}

void require(bool holds) {
    if (!holds)
        std::abort();
}

/// Every facet but each third as a chart of its own, so that vertices have to be copied.
std::vector<PlacedTriangle> charts_of(const Scene& scene) {
    std::vector<PlacedTriangle> triangles;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        if (f % 3 != 2)
            triangles.push_back({f, false, false, f, {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}});
    return triangles;
}

/// A mesh of the scene; none where no mesh is made of it.
std::optional<Mesh> mesh_of(Scene scene) {
    try {
        return Mesh(std::move(scene));
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

void check_same(const Scene& before, const Scene& after) {
    require(after.faces == before.faces);
    double largest = 0;
    for (const Vec3& v : before.vertices)
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (after.facets.size() != before.facets.size())
        return; // instances with next to no area become nodes, whose products round otherwise
    for (std::size_t f = 0; f < before.facets.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 moved = after.vertices[after.facets[f].vertex[k]] -
                               before.vertices[before.facets[f].vertex[k]];
            require(glm::length(moved) <= 1e-6 * largest);
        }
}

/// Writes the file with a lightmap; returns whether it was written.
bool write_lit(const std::string& path, const ReadResult& read, const std::string& lit,
               Binding binding, bool with_coordinates) {
    try {
        gltf::LitSource source(path, guard, Outside::refused, read.origins);
        LightmapOfFile lightmap{.pictures = {{.png = "no picture", .shown = "none"}},
                                .binding = binding};
        LightmapPicture& picture = lightmap.pictures.front();
        for (std::size_t o = 0; o < source.origins().size(); ++o)
            picture.origins.push_back(o);
        if (with_coordinates) {
            const std::optional<Mesh> mesh = mesh_of(read.scene);
            if (!mesh)
                return false;
            picture.set = source.texcoord_sets();
            picture.coordinates =
                gltf::atlas_coordinates(source, *mesh, charts_of(mesh->scene()), picture.origins);
        }
        write_lit_glb(lit, source, lightmap);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::InputFile file("a.gltf");
    static const fuzz::InputFile result("lit.glb");
    const std::string& path = file.with(data, size);
    const std::string& lit = result.with(nullptr, 0);
    constexpr std::array bindings{Binding::lit, Binding::lightmap, Binding::unlit,
                                  Binding::texture};
    try {
        const ReadResult read = [&] {
            try {
                return read_gltf(path, guard, false, Outside::refused);
            } catch (const InputError&) {
                throw TooLarge();
            }
        }();
        if (write_lit(path, read, lit, bindings[size % 4], size / 4 % 2 == 0))
            check_same(read.scene, read_gltf(lit, guard, false, Outside::refused).scene);
    } catch (const TooLarge&) {
    }
    return 0;
}
