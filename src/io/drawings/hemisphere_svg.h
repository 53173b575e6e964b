#pragma once
// The divided hemisphere of a patch, as the paper draws it (figures 4 to 7): its spherical
// triangles in parallel projection, from above and from the side, coloured by density.

#include "io/drawings/canvas.h"
#include "radiosity/hemisphere/density.h"

#include <span>
#include <string>

namespace hemilux {

struct HemisphereDrawing {
    const Hemisphere& hemisphere;
    std::string title;
    std::span<const DensityLeaf> leaves;
    std::span<const DensityCount> counts; ///< at the triangles' vertices; shown as dots
    std::span<const Vec3> rays = {};      ///< energy rays to show: unit, z is the patch's normal
};

/// Where the two views are [pixels]; seen from above the dome fills its circle.
inline constexpr int dome_width = 1280, dome_height = 790;
inline constexpr double dome_radius = 285;
inline constexpr Vec2 centre_above{330, 390}, centre_side{950, 450};

/// Both views, a colour bar, and a number at each dot of the view from above unless there are too
/// many. What the side view cannot see is left out.
void draw(const HemisphereDrawing& drawing, Canvas& canvas);

/// The same as the text of an .svg file.
[[nodiscard]] std::string hemisphere_svg(const HemisphereDrawing& drawing);

} // namespace hemilux
