#pragma once
// The divided hemisphere of a patch, as the paper draws it (figures 2 and 4 to 7). Its spherical
// triangles are drawn in parallel projection, from above and from the side, coloured by density.
// Where a patch has several hemispheres (figure 3), the view from above shows one of them. The view
// from the side shows all, each over its part of the patch.

#include "geometry/polygon.h"
#include "geometry/spherical_triangle.h"
#include "io/drawings/canvas.h"
#include "radiosity/paper/hemisphere/edge_division.h"

#include <span>
#include <string>
#include <vector>

namespace hemilux {

struct DrawnTriangle {
    SphericalTriangle shape;
    double density; ///< surfaces per ray
};

/// All directions are unit vectors, z being the patch's normal.
struct HemisphereDrawing {
    std::string title;
    std::vector<DrawnTriangle> triangles;
    std::vector<CountedDirection> counts; ///< shown as dots
    std::vector<Vec3> rays = {};          ///< energy rays to show

    /// A part of the patch, in the patch's frame, of any size.
    struct Part {
        Polygon outline;
        std::vector<DrawnTriangle> triangles;
    };
    std::vector<Part> parts = {};          ///< parts, where there are several
    std::string unit = "surfaces per ray"; ///< unit of densities
};

/// The places of the two views [pixels]; seen from above the dome fills its circle.
inline constexpr int dome_width = 1280, dome_height = 790;
inline constexpr double dome_radius = 285;
inline constexpr Vec2 centre_above{330, 390}, centre_side{950, 450};

/// Draws both views, a colour bar, and a number at each dot of the view from above unless there are
/// too many. What the side view cannot see is left out.
void draw(const HemisphereDrawing& drawing, Canvas& canvas);

/// Returns the same as the text of an .svg file.
[[nodiscard]] std::string hemisphere_svg(const HemisphereDrawing& drawing);

} // namespace hemilux
