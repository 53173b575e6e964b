#pragma once
// What two patches exchange past all that stands between them.
//
// The tree is asked for facets in the hull of the two. Where there are none, the free exchange is
// exact. Else it is multiplied by the seen share of the kernel, by lines between which these facets
// cast shadows, as many as the error asks for.

#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/factors/pairs/free_exchange.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
class PairHull;

struct PairEstimate {
    double exchange = 0;     ///< [square of the unit of length]
    double deviation = 0;    ///< its standard error; 0: nothing lies between, it is exact
    double share = 0;        ///< of the free exchange [-]
    std::uint32_t lines = 0; ///< 0: it is exact, or the two do not see each other's sides
    bool is_clear = false;   ///< facets lie in the hull, and yet no line met any
};

/// It keeps its memory from one pair to the next.
class HiddenExchange {
  public:
    /// A distance from a plane that counts as in it, in the unit of a scene in [-1,1]^3.
    static constexpr double plane_rounding = 1e-9;

    /// The tree must be that of the mesh. `panes` are those that dim light (local_panes); where
    /// none is given, panes do not count.
    HiddenExchange(const Mesh& mesh, const WideBvh& tree, std::span<const Polygon> panes = {})
        : mesh_(mesh), tree_(tree), panes_(panes) {}

    /// Returns whether neither a facet nor a pane reaches into the hull of patches i and j, whose
    /// sides are a and b and do not turn away from each other.
    [[nodiscard]] bool is_clear(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                const FacePlane& b, Facing facing);
    /// Returns whether a pane reaches into the hull of two such patches.
    [[nodiscard]] bool is_dimmed(const FacePlane& a, const FacePlane& b, Facing facing) const;

    /// Estimates the exchange of such patches, of which `free` is left where nothing stands between
    /// them. `allowed` returns the standard error that an exchange may have.
    [[nodiscard]] PairEstimate between(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                       const FacePlane& b, Facing facing, double free,
                                       std::uint64_t seed,
                                       const std::function<double(double exchange)>& allowed);

    /// Estimates the seen share of such patches right on average: a few lines decide which others
    /// estimate it, and how many, for the standard error `allowed` of the exchange. The estimate is
    /// without deviation and without lines where nothing stands between the two.
    [[nodiscard]] PairEstimate unbiased(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                        const FacePlane& b, Facing facing, double free,
                                        std::uint64_t seed, double allowed);

  private:
    void find_between(std::uint32_t i, std::uint32_t j, const PairHull& hull);

    const Mesh& mesh_;
    const WideBvh& tree_;
    std::span<const Polygon> panes_;
    std::vector<std::uint32_t> near_;
    std::vector<Polygon> between_;
};

} // namespace hemilux
