#pragma once
// What two polygons exchange, A F, for the references of hard scenes: in the open, and through
// holes in thin walls. Nothing here traces a ray or draws a random number.

#include "radiosity/engine/factors/pairs/exchange_area.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>

namespace hemilux::test {

/// A F of polygons with nothing in between. By contour integration (exchange_area.h); two
/// parallelograms that are far from each other for their size by a product Gauss rule over
/// cos cos / (pi r^2), where the contour integral would be a small difference of large terms.
[[nodiscard]] double exchange_in_the_open(const Polygon& from, const Polygon& to);

/// The same with a memory: congruent pairs are integrated once. A pair is known by its areas, the
/// angle between its normals and the sorted distances between the corners of one and of the other.
class ExchangeTable {
  public:
    [[nodiscard]] double operator()(const Polygon& from, const Polygon& to);

  private:
    using Key = std::array<std::int64_t, 19>;
    [[nodiscard]] static Key key_of(const Polygon& from, const Polygon& to);
    std::map<Key, double> known_;
};

/// Where lines are counted that run between two polygons and through others.
enum class Side {
    same,    ///< as seen from the points of `across`, on the side of the target
    opposite ///< behind these points
};
struct Aperture {
    Polygon shape;
    Side side;
};

/// The measure cos(theta) domega dA / pi of all lines that cross the parallelogram `across`, then
/// `target` on one side of it, and all apertures. With `across` a hole, `target` a surface beyond
/// it and another surface as an aperture on the opposite side this is A F between these surfaces:
///
///     A_i F_ij = int over points q of the hole of (projected solid angle of j where i lies behind)
///
/// By a product Gauss rule with points x points points over `across`. From a point q all others are
/// convex cones, and what is left of the target after cutting by them has Lambert's closed form.
[[nodiscard]] double exchange_through(const Polygon& across, const Polygon& target,
                                      std::span<const Aperture> apertures, int points);

} // namespace hemilux::test
