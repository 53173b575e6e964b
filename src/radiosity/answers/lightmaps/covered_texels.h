#pragma once
// Texels whose points no eye can see: those under or within other objects, such as a floor below a
// box that stands on it. Their darkness must not show beside the box.

#include "radiosity/answers/lightmaps/texel_map.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace hemilux {

class Tracer;
class Workers;

/// Returns marks of texels that are covered: nearly all rays from their points meet backs of faces,
/// or something that touches. `check` may throw to end it; it is called by several threads.
[[nodiscard]] std::vector<bool> find_covered(const Mesh& mesh, const Tracer& tracer,
                                             const TexelMap& texels,
                                             const std::function<void()>& check,
                                             const Workers& workers);

} // namespace hemilux
