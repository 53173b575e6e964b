#pragma once
// -o picture.exr: beside the light, what is known of the patches that pixels show.

#include "app/running/results.h"
#include "io/pictures/exr.h"

#include <functional>
#include <vector>

namespace hemilux {

/// Adds the light of each lamp, as NAME.R, NAME.G and NAME.B, to that of all together.
void add_lamp_channels(std::vector<ExrChannel>& channels, const LampLight& lamps,
                       const std::function<const Image*(const GatheredLamp&)>& image_of);

/// Returns the layers of a picture of the light: R, G, B (`light`), those of lamps, irradiance.R
/// and so on, error.R and so on (standard errors), density (mean of a patch's hemisphere, surfaces
/// per ray), patch. All but the first are those of the patch that the middle of a pixel shows, 0
/// where there is none. `patch` is 4294967295 there. Throws Interrupted.
[[nodiscard]] std::vector<ExrChannel> picture_layers(const Results& results, const Image& light,
                                                     const Camera& camera);

} // namespace hemilux
