#pragma once
// A picture of gathered light.

#include "radiosity/answers/gathering/gatherer.h"
#include "radiosity/answers/views/camera.h"

#include <functional>
#include <optional>

namespace hemilux {

/// A picture that is wanted.
struct WantedPicture {
    Camera camera;
    PixelSize size{800, 600};
    /// Is called with the picture and the number of its rows, from the top, that are gathered.
    std::function<void(const Image& picture, int rows)> rows_done = {};
};

struct LightOfPicture {
    Image image; ///< linear radiosity [W/m2]
    TargetLevel level;
};

/// Returns a picture. A signal leaves the light of the patches in the rows that are not gathered,
/// which is told, and no picture where there is no row.
[[nodiscard]] std::optional<Answer<LightOfPicture>>
gather_picture(Gatherer& gatherer, const WantedPicture& picture,
               const std::optional<WholeLight>& whole = {});

} // namespace hemilux
