#pragma once
// Finds which sides of which facets light may reach. A side is in reach if it and something that
// shines are at least partly in front of each other, and neither lies under another facet
// (covered_sides.h). What else stands between is not looked at. What is lit and reflects shines in
// turn.

#include <vector>

namespace hemilux {

class Mesh;

/// Returns, by patch, whether light may reach it. The answer is never false where light comes; it
/// is true where that would take too long to find out.
[[nodiscard]] std::vector<bool> find_lit_patches(const Mesh& mesh);

} // namespace hemilux
