#pragma once
// Divides some patches of a mesh further, each as often as is asked for.

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;

/// Divides each patch `levels[patch]` times: each level makes four patches of one, or two of a long
/// one. The larger of the levels of a patch's two sides counts. Facets, and tracers of them, remain
/// valid. Returns for each new patch the old one that it is a piece of.
std::vector<std::uint32_t> refine(Mesh& mesh, std::span<const std::uint8_t> levels);

} // namespace hemilux
