#pragma once
// This says whether a scene needs division, for those who have not solved it yet.

#include <optional>

namespace hemilux {

class Mesh;
class Tracer;

/// Returns how far the light is off within the patches of a mesh, relative to it [-], from a rough
/// solution. It is empty where nothing is lit or the scene cannot be solved, and where there are
/// more patches than a plain run divides; NaN where half a minute was not enough. All cores work at
/// it.
[[nodiscard]] std::optional<double> error_within_patches(const Mesh& mesh, const Tracer& tracer);

} // namespace hemilux
