#include "app/report/mesh_arrays.h"

#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <span>
#include <vector>

namespace hemilux {

void write_halves(PageFile& page, const std::string& id, std::span<const std::uint16_t> halves) {
    page.array(id, halves.size() / 3, [&](std::size_t i, std::string& bytes) {
        for (const std::uint16_t half : halves.subspan(3 * i, 3))
            append_number(bytes, half);
    });
}

void write_mesh_arrays(PageFile& page, const Mesh& mesh, const CornerClasses& classes) {
    const double unit = 1 / mesh.frame().scale;
    write_numbers(page, "position", classes.position.size(),
                  [&](std::size_t v) { return classes.position[v] * unit; });
    page.array("corners", classes.of_patch.size(), [&](std::size_t i, std::string& bytes) {
        for (const std::uint32_t vertex : classes.of_patch[i])
            append(bytes, vertex);
    });
    std::vector<std::array<std::uint32_t, 4>> triangles;
    for (const Outline& outline : classes.outlines)
        for_each_triangle(classes, outline.patch, [&](auto... corners) {
            triangles.push_back({outline.patch, corners...});
        });
    if (!triangles.empty())
        page.array("triangles", triangles.size(), [&](std::size_t t, std::string& bytes) {
            for (const std::uint32_t word : triangles[t])
                append(bytes, word);
        });
    const std::span<const Patch> patches = mesh.patches();
    const auto write = [&](const char* id, const auto& value_of) {
        write_numbers(page, id, patches.size(), value_of);
    };
    const auto facet = [&](std::size_t i) { return mesh.scene().facets[patches[i].facet]; };
    write("area", [&](std::size_t i) { return mesh.frame().area_to_world(patches[i].area); });
    write("face", [&](std::size_t i) { return facet(i).face; });
    write("material", [&](std::size_t i) { return patches[i].material; });
    write("group", [&](std::size_t i) { return facet(i).group; });
    if (textures_of(mesh.scene()).of_material.empty())
        return;
    write("reflectance", [&](std::size_t i) { return mesh.material(patches[i]).reflectance; });
    write("emission", [&](std::size_t i) { return mesh.material(patches[i]).emission; });
}

} // namespace hemilux
