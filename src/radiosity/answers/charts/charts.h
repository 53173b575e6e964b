#pragma once
// The places of surfaces in a lightmap of our own: charts of facets that are laid flat together
// (chart_regions.h), packed into a square.

#include "geometry/vector.h"
#include "radiosity/answers/charts/chart_regions.h"
#include "radiosity/answers/vertices/smooth.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace hemilux {

class Mesh;

/// The number of texels around each chart that have its light too, so that viewers may interpolate
/// at its edges.
inline constexpr int gutter = 2;

/// Sides of facets of one material, projected onto a plane.
struct LightmapChart {
    Vec3 along, across;        ///< unit, in the plane, local frame
    Vec2 low{0.0}, high{0.0};  ///< extent along both, local frame
    int column = 0, row = 0;   ///< place of the texel in whose middle `low` lies
    int columns = 0, rows = 0; ///< texels from there to the one in whose middle `high` lies
    std::vector<ChartSide> sides;
    std::vector<std::uint32_t> patches; ///< of these sides

    /// Returns the place of a point in texels, from the corner of the picture. The middle of the
    /// first texel is (0.5, 0.5).
    [[nodiscard]] Vec2 place(const Vec3& point) const;
};

/// The error that charts do not fit, however coarse they are.
struct LightmapTooSmall : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct AtlasOptions {
    int size = 0;       ///< texels along a side; 0: as many as the density needs
    double density = 0; ///< texels per local unit of length; 0: the largest that fits
    int margin = gutter;
    int max_size = 16384;
};

struct Atlas {
    std::vector<LightmapChart> charts;
    int size; ///< texels along a side
};

/// Makes charts of these sides in a square. All surfaces have the same density of texels, but a
/// chart has at least 2 x 2 of them. The edges of a rectangle lie in the middles of texels, so
/// interpolation is exact there. Throws LightmapTooSmall.
[[nodiscard]] Atlas make_atlas(const Mesh& mesh, std::span<const ChartSide> sides,
                               const AtlasOptions& options);

/// Returns both sides of two-sided facets, and the front of others, without suns and skies.
[[nodiscard]] std::vector<ChartSide> sides_with_light(const Mesh& mesh);

/// Makes charts of all of them in size x size texels. Throws LightmapTooSmall.
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
