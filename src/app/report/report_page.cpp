#include "app/report/report_page.h"

#include "app/report/assets.h"
#include "app/report/base64.h"
#include "io/files/atomic_file.h"
#include "io/files/little_endian.h"
#include "io/results/smooth.h"
#include "radiosity/scene/mesh.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace hemilux {
namespace {

void append(std::string& bytes, std::uint32_t word) { append_bits(bytes, word); }
void append(std::string& bytes, double value) { append_number(bytes, static_cast<float>(value)); }
void append(std::string& bytes, const Vec3& v) {
    for (int i = 0; i < 3; ++i)
        append(bytes, v[i]);
}

/// Writes the element of an array: `append_row(i, bytes)` for each of `rows` rows.
template <class AppendRow>
void write_array(AtomicFile& file, const std::string& name, std::size_t rows,
                 const AppendRow& append_row) {
    constexpr std::size_t rows_at_a_time = 3 << 12; // words of 4 bytes: no padding between them
    file.write("<script type=\"application/base64\" id=\"" + name + "\">");
    std::string bytes;
    for (std::size_t i = 0; i < rows; ++i) {
        append_row(i, bytes);
        if ((i + 1) % rows_at_a_time == 0 || i + 1 == rows) {
            file.write(base64(bytes));
            bytes.clear();
        }
    }
    file.write("</script>\n");
}

void write_vertices(AtomicFile& file, const Mesh& mesh, const Solution& solution) {
    const CornerClasses classes = find_corner_classes(mesh);
    const std::vector<Vec3> light = smooth(mesh, classes, solution.radiosity, solution.slope);
    const double unit = 1 / mesh.frame().scale;
    write_array(file, "position", classes.position.size(), [&](std::size_t v, std::string& bytes) {
        append(bytes, classes.position[v] * unit);
    });
    write_array(file, "light", light.size(),
                [&](std::size_t v, std::string& bytes) { append(bytes, light[v]); });
    write_array(file, "corners", classes.of_patch.size(), [&](std::size_t i, std::string& bytes) {
        for (const std::uint32_t vertex : classes.of_patch[i])
            append(bytes, vertex);
    });
}

void write_patches(AtomicFile& file, const Mesh& mesh, const Solution& solution) {
    const std::span<const Patch> patches = mesh.patches();
    const auto write = [&](const char* name, const auto& value_of) {
        write_array(file, name, patches.size(),
                    [&](std::size_t i, std::string& bytes) { append(bytes, value_of(i)); });
    };
    const auto facet = [&](std::size_t i) { return mesh.scene().facets[patches[i].facet]; };
    write("area", [&](std::size_t i) { return mesh.frame().area_to_world(patches[i].area); });
    write("radiosity", [&](std::size_t i) { return solution.radiosity[i]; });
    if (!solution.standard_error.empty())
        write("error", [&](std::size_t i) { return solution.standard_error[i]; });
    write("face", [&](std::size_t i) { return facet(i).face; });
    write("material", [&](std::size_t i) { return patches[i].material; });
    write("group", [&](std::size_t i) { return facet(i).group; });
    if (!solution.hits.empty())
        write("hits", [&](std::size_t i) { return static_cast<double>(solution.hits[i]); });
    if (mesh.scene().textures.of_material.empty())
        return;
    write("reflectance", [&](std::size_t i) { return mesh.material(patches[i]).reflectance; });
    write("emission", [&](std::size_t i) { return mesh.material(patches[i]).emission; });
}

/// Writes the page up to a mark, and returns what comes after it.
std::string_view write_until(AtomicFile& file, std::string_view page, std::string_view mark) {
    const std::size_t at = page.find(mark);
    file.write(page.substr(0, at));
    return page.substr(at + mark.size());
}

} // namespace

void write_report_page(const std::string& path, const ReportContent& content) {
    AtomicFile file(path);
    std::string_view page = write_until(file, assets::html, "/* page.css */");
    file.write(assets::style);
    page = write_until(file, page, "<!-- data -->");
    file.write("<script type=\"application/json\" id=\"run\">" + run_json(content) + "</script>\n");
    write_vertices(file, content.mesh, content.solution);
    write_patches(file, content.mesh, content.solution);
    page = write_until(file, page, "/* *.js */");
    file.write(assets::script);
    file.write(page);
    file.commit();
}

} // namespace hemilux
