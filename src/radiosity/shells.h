#pragma once
// Shells: the parts of a scene that hang together by edges of exactly two facets, and whether each
// can be given one outer and one inner side. Two neighbours agree where they run along their common
// edge in opposite directions.

#include "radiosity/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Shell {
    std::size_t begin, end; ///< in Shells::facets
    bool closed = true;     ///< every edge has exactly two facets
    bool consistent = true; ///< all neighbours agree
    bool orientable = true; ///< they would, if some were turned; not so for a Moebius strip
};

struct Shells {
    std::vector<Shell> all;
    std::vector<std::uint32_t> facets; ///< shell after shell
    /// By facet: to be turned so that its shell becomes consistent, with as little area turned as
    /// possible.
    std::vector<bool> against;
    std::size_t clashing_edges = 0; ///< of two facets that do not agree

    [[nodiscard]] std::span<const std::uint32_t> facets_of(const Shell& shell) const {
        return std::span(facets).subspan(shell.begin, shell.end - shell.begin);
    }
};

class Mesh;

/// What a closed shell encloses, in the local frame and once it is consistent; negative where it is
/// inside out. About 0 for a folded sheet.
[[nodiscard]] double signed_volume(const Mesh& mesh, const Shells& shells, const Shell& shell);

/// O(n log n) in the facets.
[[nodiscard]] Shells find_shells(const Scene& scene);

} // namespace hemilux
