#pragma once
// The patches of a mesh as arrays of a page.

#include "app/report/page_file.h"
#include "geometry/vector.h"
#include "io/files/little_endian.h"
#include "radiosity/answers/vertices/smooth.h"

#include <cstdint>
#include <span>
#include <string>

namespace hemilux {

class Mesh;

inline void append(std::string& bytes, std::uint32_t word) { append_number(bytes, word); }
/// Appends the value in single precision.
inline void append(std::string& bytes, double value) {
    append_number(bytes, static_cast<float>(value));
}
inline void append(std::string& bytes, const Vec3& v) { append_numbers(bytes, glm::vec3(v)); }

/// Writes the element `id` with a number or a Vec3, `value_of(i)`, for each i below `count`.
template <class Value>
void write_numbers(PageFile& page, const char* id, std::size_t count, const Value& value_of) {
    page.array(id, count, [&](std::size_t i, std::string& bytes) { append(bytes, value_of(i)); });
}

/// Writes the element `id` with three halves for each patch (readHalves of data.js).
void write_halves(PageFile& page, const std::string& id, std::span<const std::uint16_t> halves);

/// Writes position, corners, triangles, area, face, material and group, and where there are
/// textures reflectance and emission, as report_page.h lists them.
void write_mesh_arrays(PageFile& page, const Mesh& mesh, const CornerClasses& classes);

} // namespace hemilux
