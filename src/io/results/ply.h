#pragma once
// The mesh with its radiosity as vertex colours, for viewers and baking: PLY (Turk 1994), binary
// little endian.

#include "geometry/vector.h"

#include <span>
#include <string>

namespace hemilux {

class Mesh;
struct Slope;
struct CornerClasses;

/// Writes vertices x, y, z (double, world units) and red, green, blue (float, linear radiosity,
/// smoothed over corners); faces are the patches, in the mesh's order. Patches share a vertex where
/// they share its radiosity. Throws OutputError.
void write_ply(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity);
/// The same where the mesh's classes of corners are known already.
/// `slope`: as of smooth().
void write_ply(const std::string& path, const Mesh& mesh, std::span<const Vec3> radiosity,
               const CornerClasses& classes, std::span<const Slope> slope = {});

} // namespace hemilux
