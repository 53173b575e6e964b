#pragma once
// The subdivision in a plane, as the paper's figure 1 draws it: a patch in cross-section, the half
// circle over it with rays at the directions of the subdivision, and what of the scene the plane
// cuts.

#include "radiosity/hemisphere/edge_division.h"

#include <array>
#include <string>
#include <vector>

namespace hemilux {

class Mesh;

/// In the frame of a hemisphere: x in the plane, z along the patch's normal, in local units.
struct PlaneSection {
    std::array<Vec2, 2> end; ///< x and z of a patch that the plane y = 0 cuts, at z >= 0
    bool own;                ///< of the patch under the hemisphere
};

/// What the plane y = 0 of a patch's hemisphere over `centre` cuts.
[[nodiscard]] std::vector<PlaneSection> cut_by_plane(const Mesh& mesh, std::uint32_t patch,
                                                     const Vec3& centre);

struct PlaneDrawing {
    std::string title;
    std::vector<CountedDirection> counts; ///< those with y = 0 are drawn
    std::vector<PlaneSection> sections;
};

/// The text of an .svg file: rays through the half circle, each with the surfaces along it.
[[nodiscard]] std::string plane_svg(const PlaneDrawing& drawing);

} // namespace hemilux
