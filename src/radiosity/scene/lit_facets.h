#pragma once
// Which sides of which facets light may reach, whatever stands between them: a side is out of reach
// if nothing that shines is even partly in front of it while it is partly in front of that. What is
// lit and reflects shines in turn.

#include <vector>

namespace hemilux {

class Mesh;

/// By patch: whether light may reach it. Never false where light comes; true where that would take
/// too long to find out.
[[nodiscard]] std::vector<bool> find_lit_patches(const Mesh& mesh);

} // namespace hemilux
