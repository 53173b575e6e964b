#pragma once
// Finds shells: the parts of a scene that hang together by edges of exactly two facets. Also finds
// whether each can be given one outer and one inner side. Two neighbours agree where they run along
// their common edge in opposite directions.

#include "radiosity/paper/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

struct Shell {
    std::size_t begin, end; ///< range in Shells::facets
    bool closed = true;     ///< every edge has exactly two facets
    bool consistent = true; ///< all neighbours agree
    bool orientable = true; ///< they would, if some were turned; not so for a Moebius strip
    double against = 0;     ///< the share of its area that would be turned, at most a half
    /// The way a closed shell faces once it is consistent: 1 outwards, -1 inwards, 0 if it encloses
    /// nothing, as a folded sheet.
    int outwards = 0;
};

struct Shells {
    std::vector<Shell> all;
    std::vector<std::uint32_t> facets; ///< shell after shell
    std::vector<std::uint32_t> of;     ///< the shell of a facet
    /// The facets to be turned so that their shells become consistent, with as little area turned
    /// as possible.
    std::vector<bool> against;
    std::size_t shared_edges = 0;   ///< edges of two facets
    std::size_t clashing_edges = 0; ///< those of these where the two do not agree

    [[nodiscard]] std::span<const std::uint32_t> facets_of(const Shell& shell) const {
        return std::span(facets).subspan(shell.begin, shell.end - shell.begin);
    }
};

/// Finds the shells of a scene of n facets in O(n log n) time.
[[nodiscard]] Shells find_shells(const Scene& scene);

} // namespace hemilux
