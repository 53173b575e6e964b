#pragma once
// What a pixel shows of a textured surface.

#include "io/rendering/visible_facets.h"
#include "radiosity/scene/textured_facets.h"

namespace hemilux {

/// The mean colours within the square of a pixel around a place (in pixels), on the plane of the
/// facet's half that shows there; where that square meets the horizon, those of the patch.
[[nodiscard]] Colours pixel_colours(const Mesh& mesh, const VisibleFacets& visible,
                                    std::uint32_t half, std::uint32_t patch, const Vec2& place);

} // namespace hemilux
