#pragma once
// Parts of the sky, each a column of view factors: bands of equal steps of altitude, or the 145
// patches of Tregenza (1987, "Subdivision of the sky hemisphere for luminance measurements").

#include "geometry/vector.h"
#include "radiosity/engine/factors/rows/open_share.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hemilux {

/// Rings of equal height from the horizon to the zenith, each of equal parts. The first part of a
/// ring is centred on north, and the others follow clockwise as seen from above. North and east are
/// y and x where z is up, -z and x where y is up, z and y where x is up.
class SkyBands {
  public:
    /// Makes `count` whole rings, 1 at least.
    [[nodiscard]] static SkyBands of_equal_steps(unsigned count, int up);
    /// Makes 7 rings of 12 degrees with 30, 30, 24, 24, 18, 12 and 6 parts, and the zenith.
    [[nodiscard]] static SkyBands tregenza(int up);

    [[nodiscard]] std::size_t size() const { return first_.back(); }
    /// Returns the band of a unit direction that points upwards.
    [[nodiscard]] std::size_t of(const Vec3& direction) const;
    /// Returns `sky 0-10` for a ring by its altitudes in degrees, `sky 17` for a patch of Tregenza
    /// by its number from 1.
    [[nodiscard]] std::string name(std::size_t band) const;
    /// Returns the direction of the middle of a band; of a whole ring, up.
    [[nodiscard]] Vec3 middle(std::size_t band) const;

  private:
    SkyBands(double step, std::vector<std::size_t> parts, int up);
    [[nodiscard]] std::size_t ring_of(std::size_t band) const;

    double step_;                            ///< of altitude [degrees]; the last ring ends at 90
    std::vector<std::size_t> parts_, first_; ///< by ring; `first_` ends with the sum
    std::vector<double> lower_;              ///< sine of the lowest altitude, by ring
    Vec3 east_{0.0}, north_{0.0}, up_{0.0};
};

/// Returns the shares of rays that went to each band, of `rays` rays. The standard error is that of
/// independent rays, with half a ray on either side besides, so that it is never 0.
[[nodiscard]] std::vector<OpenShare> shares_of(std::span<const std::uint32_t> counts,
                                               std::uint32_t rays);

/// Scales shares and errors so that the shares sum to `sum`; spreads it evenly where all are 0.
void scale_to_sum(std::span<OpenShare> shares, double sum);

} // namespace hemilux
