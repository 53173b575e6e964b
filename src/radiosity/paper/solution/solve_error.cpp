#include "radiosity/paper/solution/solve_error.h"

#include "radiosity/paper/scene/mesh.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace hemilux {
namespace {

bool fits(const Vec3& v) {
    return std::abs(v.x) <= largest_radiosity && std::abs(v.y) <= largest_radiosity &&
           std::abs(v.z) <= largest_radiosity;
}

std::string text_of(const Vec3& v) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%g %g %g", v.x, v.y, v.z);
    return text.data();
}

} // namespace

std::uint32_t face_of(const Mesh& mesh, std::uint32_t patch) {
    return mesh.scene().facets[mesh.patches()[patch].facet].face;
}

std::string name_of_patch(const Mesh& mesh, std::uint32_t patch) {
    return "patch " + std::to_string(patch) + " (face " + std::to_string(face_of(mesh, patch)) +
           ", material '" + mesh.scene().materials[mesh.patches()[patch].material].name + "')";
}

void check_finite(const Mesh& mesh, std::uint32_t patch, const Vec3& value, const char* what,
                  std::uint64_t step) {
    if (fits(value))
        return;
    const std::string when =
        step > 0 ? "step " + std::to_string(step) + ": " : "before the first step: ";
    throw SolveError(when + what + " of " + name_of_patch(mesh, patch) + " is " + text_of(value) +
                         ", which is no number to go on with; scale emissions down",
                     face_of(mesh, patch));
}

void check_finite(const Mesh& mesh, std::span<const Vec3> values, const char* what,
                  std::uint64_t step) {
    for (std::uint32_t i = 0; i < values.size(); ++i)
        check_finite(mesh, i, values[i], what, step);
}

} // namespace hemilux
