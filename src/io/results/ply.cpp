#include "io/results/ply.h"

#include "io/files/atomic_file.h"
#include "io/results/smooth.h"
#include "radiosity/scene/mesh.h"

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>

namespace hemilux {
namespace {

/// The bytes of a number, lowest first, whatever the machine's order is.
template <std::unsigned_integral Bits>
void append_bits(std::string& bytes, Bits bits) {
    for (std::size_t i = 0; i < sizeof bits; ++i)
        bytes += static_cast<char>(static_cast<unsigned char>(bits >> (8 * i)));
}
void append(std::string& bytes, double value) {
    append_bits(bytes, std::bit_cast<std::uint64_t>(value));
}
void append(std::string& bytes, float value) {
    append_bits(bytes, std::bit_cast<std::uint32_t>(value));
}

std::string header(std::size_t vertices, std::size_t faces) {
    return "ply\nformat binary_little_endian 1.0\n"
           "comment radiosity [W/m2 leaving], linear, as vertex colours\n"
           "element vertex " +
           std::to_string(vertices) +
           "\nproperty double x\nproperty double y\nproperty double z\n"
           "property float red\nproperty float green\nproperty float blue\n"
           "element face " +
           std::to_string(faces) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

} // namespace

void write_ply(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity) {
    write_ply(path, mesh, radiosity, find_corner_classes(mesh));
}

void write_ply(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity,
               const CornerClasses& classes, std::span<const Slope> slope) {
    const std::vector<Vec3> colours = smooth(mesh, classes, radiosity, slope);
    AtomicFile file(path);
    file.write(header(classes.position.size(), mesh.patches().size()));
    std::string record;
    for (std::size_t k = 0; k < classes.position.size(); ++k) {
        record.clear();
        const Vec3 position = mesh.frame().to_world(classes.position[k]);
        for (int axis = 0; axis < 3; ++axis)
            append(record, position[axis]);
        for (int channel = 0; channel < 3; ++channel)
            append(record, static_cast<float>(colours[k][channel]));
        file.write(record);
    }
    for (std::size_t i = 0; i < mesh.patches().size(); ++i) {
        record.clear();
        const auto corners = static_cast<std::size_t>(mesh.patches()[i].shape.size());
        record += static_cast<char>(corners);
        for (std::size_t c = 0; c < corners; ++c)
            append_bits(record, classes.of_patch[i][c]);
        file.write(record);
    }
    file.commit();
}

} // namespace hemilux
