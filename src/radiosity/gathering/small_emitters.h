#pragma once
// Which emitters are reached by shadow rays, and which are left to rays at random.

#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;

/// Patches that emit and are better reached by shadow rays: those that fill little of what other
/// patches see, so that rays at random would find them by luck. The brightest are taken first, as
/// long as all of them together fill less than three tenths of the view of the patches that
/// reflect. In a closed room a share of the view is about a share of the area; a large and distant
/// sun has much area and fills little. A facet's patches are all among them or none.
[[nodiscard]] std::vector<std::uint32_t> small_emitters(const Mesh& mesh);

} // namespace hemilux
