#pragma once
// The places of surfaces in a lightmap: a chart for each plane group of facets, packed into a
// square.

#include "geometry/vector.h"
#include "io/results/smooth.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace hemilux {

class Mesh;

/// The number of texels around each chart that have its light too, so that viewers may interpolate
/// at its edges.
inline constexpr int gutter = 2;

/// One side of facets in one plane that meet at edges and have one material.
struct LightmapChart {
    Vec3 along, across;        ///< unit, in the plane, local frame
    Vec2 low{0.0}, high{0.0};  ///< extent along both, local frame
    int column = 0, row = 0;   ///< place of the texel in whose middle `low` lies
    int columns = 0, rows = 0; ///< texels from there to the one in whose middle `high` lies
    std::vector<std::uint32_t> patches;

    /// Returns the place of a point in texels, from the corner of the picture. The middle of the
    /// first texel is (0.5, 0.5).
    [[nodiscard]] Vec2 place(const Vec3& point) const;
};

/// The error that charts do not fit, however coarse they are.
struct LightmapTooSmall : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Makes charts of all patches but suns and skies, in a square of `size` x `size` texels. All
/// surfaces have the same density of texels, the largest that fits, but a chart has at least 2 x 2
/// of them. The edges of a rectangle lie in the middles of texels, so interpolation is exact there.
/// Throws LightmapTooSmall.
[[nodiscard]] std::vector<LightmapChart> find_charts(const Mesh& mesh, int size);

/// Classes of corners, divided where charts meet.
struct ChartCorners {
    CornerClasses classes;
    std::vector<std::uint32_t> class_of; ///< class before the division
    std::vector<Vec2> place;             ///< LightmapChart::place()
};
[[nodiscard]] ChartCorners divide_by_charts(const Mesh& mesh, const CornerClasses& classes,
                                            const std::vector<LightmapChart>& charts);

} // namespace hemilux
