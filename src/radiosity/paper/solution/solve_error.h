#pragma once
// Reports the reason why a scene cannot be solved, found before the first step or within one. The
// solution of the steps before remains.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// The error thrown when a scene cannot be solved; what() names the patch, its face and material,
/// and the step.
struct SolveError : std::runtime_error {
    SolveError(const std::string& message, std::uint32_t first_face)
        : std::runtime_error(message), face(first_face) {}
    std::uint32_t face; ///< a face of the file it is about, from 0
};

/// Larger radiosities are refused, so that sums of their squares remain finite [W/m2].
inline constexpr double largest_radiosity = 1e145;
/// Emission of a channel that is everywhere less than this, and not 0, is refused too: squares
/// would vanish [W/m2].
inline constexpr double min_radiosity = 1e-145;

/// Returns the face of the file that a patch is part of, counted from 0.
[[nodiscard]] std::uint32_t face_of(const Mesh& mesh, std::uint32_t patch);
/// Returns a patch's name in messages, such as "patch 3 (face 1, material 'wall')".
[[nodiscard]] std::string name_of_patch(const Mesh& mesh, std::uint32_t patch);

/// Throws SolveError for the first patch whose value is not finite, or beyond largest_radiosity.
/// `step` counts from 1; 0 stands for before the first.
void check_finite(const Mesh& mesh, std::span<const Vec3> values, const char* what,
                  std::uint64_t step);
/// Checks the same of one patch.
void check_finite(const Mesh& mesh, std::uint32_t patch, const Vec3& value, const char* what,
                  std::uint64_t step);

} // namespace hemilux
