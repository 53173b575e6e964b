#pragma once
// -o picture.exr: beside the light, what is known of the patches that pixels show.

#include "app/outputs/results.h"
#include "io/pictures/exr.h"

#include <span>
#include <vector>

namespace hemilux {

/// Calls part(mesh, solution) for each layer, and returns what these give.
template <class Part>
auto of_each_layer(const Results& results, const Part& part) {
    const LampLight& light = results.lamps;
    std::vector<decltype(part(results.mesh, results.solution))> parts;
    for (std::uint32_t k = 0; k < light.patches.size(); ++k)
        parts.push_back(part(lit_by_layer(results.mesh, light.lamps, k),
                             solution_of(results.solution, light.patches[k])));
    return parts;
}

/// Adds the light of each lamp, as NAME.R, NAME.G and NAME.B, to that of all together. `images` has
/// as many as there are layers.
void add_lamp_channels(std::vector<ExrChannel>& channels, const LampLayers& lamps,
                       std::span<const Image> images);

/// Returns the layers of a picture of the light: R, G, B (`light`), those of lamps, irradiance.R
/// and so on, error.R and so on (standard errors), density (mean of a patch's hemisphere, surfaces
/// per ray), patch. All but the first are those of the patch that the middle of a pixel shows, 0
/// where there is none. `patch` is 4294967295 there. `lamps` are as in add_lamp_channels(). Throws
/// Interrupted.
[[nodiscard]] std::vector<ExrChannel> picture_layers(const Results& results, const Image& light,
                                                     std::span<const Image> lamps,
                                                     const Camera& camera);

} // namespace hemilux
