#pragma once
// The colours of a textured surface that a pixel shows.

#include "radiosity/answers/pictures/visible_facets.h"
#include "radiosity/light/textures/textured_facets.h"

namespace hemilux {

/// Returns the mean colours within the square of a pixel around a place (in pixels), on the plane
/// of the facet's half that shows there. Where that square meets the horizon, it returns those of
/// the patch.
[[nodiscard]] Colours pixel_colours(const Mesh& mesh, const VisibleFacets& visible,
                                    std::uint32_t half, std::uint32_t patch, const Vec2& place);

} // namespace hemilux
