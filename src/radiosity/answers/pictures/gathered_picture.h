#pragma once
// A picture whose light is gathered at its pixels (picture_gather.h).
//
// At the edge of a shadow, each pixel first traces a few shadow rays, which differ from pixel to
// pixel. They say which share of the direct light arrives. Then a pixel takes the share of the four
// by four pixels of its surface around it. Each such square has one well distributed set of shadow
// rays. Where the share changes more abruptly than the noise of these rays explains, as at the edge
// of a sharp shadow, a pixel keeps its own share as far as that is likely to be nearer (Lee 1980).

#include "radiosity/answers/images/image.h"
#include "radiosity/answers/pictures/picture_gather.h"
#include "radiosity/answers/pictures/render.h"

#include <functional>
#include <span>

namespace hemilux {

struct RowWork {
    std::function<void()> check; ///< throws Interrupted to end it; is called by several threads
    std::function<void(const Image& picture, int rows)> rows_done; ///< RenderOptions::rows_done
};

/// Renders linear radiosity, row after row from the top. `offsets` are those of the samples in a
/// pixel; `panes` is null where there are none.
[[nodiscard]] RowsOfPicture gathered_picture(const Mesh& mesh, const VisibleFacets& visible,
                                             PictureGather& gather, const Tracer* panes,
                                             std::span<const Vec2> offsets, int width, int height,
                                             const RowWork& work, const Workers& workers);

/// Returns the share that panes let through to what a pixel of the band shows.
[[nodiscard]] double passed_through_panes(const VisibleFacets& visible, const Tracer& tracer,
                                          const VisibleFacets::Band& band, int x, int y);

} // namespace hemilux
