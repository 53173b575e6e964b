#pragma once
// The subdivision in a plane, as the paper's figure 1 draws it. It shows a patch in cross-section
// and the half circle over it, with rays at the directions of the subdivision. It also shows what
// the plane cuts of the scene.

#include "radiosity/paper/hemisphere/edge_division.h"

#include <array>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// A section of a patch in the frame of a hemisphere: x in the plane, z along the patch's normal,
/// in local units.
struct PlaneSection {
    std::array<Vec2, 2> end; ///< x and z of a patch that the plane y = 0 cuts, at z >= 0
    bool own;                ///< it belongs to the patch under the hemisphere
};

/// Returns what the plane y = 0 of a patch's hemisphere over `centre` cuts.
[[nodiscard]] std::vector<PlaneSection> cut_by_plane(const Mesh& mesh, std::uint32_t patch,
                                                     const Vec3& centre);

struct PlaneDrawing {
    std::string title;
    std::vector<CountedDirection> counts; ///< those with y = 0 are drawn
    std::vector<PlaneSection> sections;
};

/// Returns the text of an .svg file: rays through the half circle, each with the surfaces along it.
[[nodiscard]] std::string plane_svg(const PlaneDrawing& drawing);

} // namespace hemilux
