#include "io/meshes/ply.h"

#include "io/files/atomic_file.h"
#include "io/files/little_endian.h"
#include "radiosity/answers/images/image.h"
#include "radiosity/answers/images/tone.h"
#include "radiosity/paper/scene/mesh.h"

#include <span>

namespace hemilux {
namespace {

std::string light_properties(const std::string& prefix) {
    std::string text;
    for (const char* const channel : {"red", "green", "blue"})
        text += "property float " + prefix + channel + "\n";
    return text;
}

std::string header(std::size_t vertices, std::size_t faces, Bake bake, PlyColours colours) {
    const std::string name = name_of(bake);
    const std::string unit = bake == Bake::radiosity ? " [W/m2 leaving]" : " [W/m2 arriving]";
    return "ply\nformat binary_little_endian 1.0\n"
           "comment " +
           name + unit + ", linear, as vertex " +
           (colours == PlyColours::linear ? "colours" : "properties; colours in sRGB") +
           "\nelement vertex " + std::to_string(vertices) +
           "\nproperty double x\nproperty double y\nproperty double z\n" +
           (colours == PlyColours::linear
                ? light_properties("")
                : "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                  "property float quality\n" +
                      light_properties(name + "_")) +
           "element face " + std::to_string(faces) +
           "\nproperty list uchar uint vertex_indices\nend_header\n";
}

void append_colour(std::string& record, const Vec3& light, const Display& display,
                   PlyColours colours) {
    const glm::vec3 linear(light);
    if (colours == PlyColours::shown) {
        const glm::vec3 shown = display(linear);
        for (int channel = 0; channel < 3; ++channel)
            append_number(record, srgb_byte(shown[channel]));
        append_number(record, luminance(linear));
    }
    append_numbers(record, linear);
}

} // namespace

void write_ply(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const VertexLight& light, PlyColours colours) {
    AtomicFile file(path);
    std::size_t faces = mesh.patches().size();
    for (const Outline& outline : classes.outlines)
        faces += outline.triangles.size() - 1;
    file.write(header(classes.position.size(), faces, light.bake, colours));
    std::string record;
    for (std::size_t k = 0; k < classes.position.size(); ++k) {
        record.clear();
        append_numbers(record, mesh.frame().to_world(classes.position[k]));
        append_colour(record, light.of_class[k], light.display, colours);
        file.write(record);
    }
    const auto append_face = [&](std::span<const std::uint32_t> vertices) {
        record += static_cast<char>(vertices.size());
        for (const std::uint32_t vertex : vertices)
            append_number(record, vertex);
    };
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        record.clear();
        const auto corners = static_cast<std::size_t>(mesh.patches()[i].shape.size());
        if (outline_of(classes, i))
            for_each_triangle(classes, i, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                append_face(std::array{a, b, c});
            });
        else
            append_face(std::span(classes.of_patch[i]).first(corners));
        file.write(record);
    }
    file.commit();
}

} // namespace hemilux
