#pragma once
// A picture whose light is gathered at its pixels (picture_gather.h).
//
// At the edge of a shadow, each pixel first traces a few shadow rays, which differ from pixel to
// pixel. They say which share of the direct light arrives. Then a pixel takes the share of the four
// by four pixels of its surface around it. Each such square has one well distributed set of shadow
// rays. Where the share changes more abruptly than the noise of these rays explains, as at the edge
// of a sharp shadow, a pixel keeps its own share as far as that is likely to be nearer (Lee 1980).

#include "io/pictures/image.h"
#include "io/rendering/picture_gather.h"

#include <functional>
#include <span>

namespace hemilux {

/// Renders linear radiosity. `offsets` are those of the samples in a pixel; `check` may throw to
/// end it, and is called by several threads.
[[nodiscard]] Image gathered_picture(const Mesh& mesh, const VisibleFacets& visible,
                                     const PictureGather& gather, std::span<const Vec2> offsets,
                                     int width, int height, const std::function<void()>& check,
                                     const Workers& workers);

} // namespace hemilux
