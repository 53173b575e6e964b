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
#include <vector>

namespace hemilux {

class Mesh;

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

    /// Both must outlive this. The tree must be that of the mesh.
    HiddenExchange(const Mesh& mesh, const WideBvh& tree) : mesh_(mesh), tree_(tree) {}

    /// Estimates the exchange of patches i and j, whose sides are a and b and do not turn away from
    /// each other. `allowed` returns the standard error that an exchange may have.
    [[nodiscard]] PairEstimate between(std::uint32_t i, const FacePlane& a, std::uint32_t j,
                                       const FacePlane& b, Facing facing, std::uint64_t seed,
                                       const std::function<double(double exchange)>& allowed);

  private:
    void find_between(std::uint32_t i, const FacePlane& a, const ConvexPart& of_a, std::uint32_t j,
                      const FacePlane& b, const ConvexPart& of_b);

    const Mesh& mesh_;
    const WideBvh& tree_;
    std::vector<std::uint32_t> near_;
    std::vector<Polygon> between_;
};

} // namespace hemilux
