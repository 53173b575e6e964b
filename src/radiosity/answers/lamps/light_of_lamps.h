#pragma once
// The light of each lamp by itself. It is found by the rays of a run whose lamps all shine, and the
// sum over lamps is the light of that run: by patch, point, texel and pixel.

#include "radiosity/answers/gathering/wanted_light.h"
#include "radiosity/engine/solving/relighting.h"
#include "radiosity/light/lamps/lamp_layers.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hemilux {

/// A layer has the light of one lamp, or of lamps that belong together.
struct LampLight : LampPatches {
    std::vector<std::vector<PointLight>> points; ///< by layer and wanted point
    std::vector<Image> pictures;                 ///< by layer; empty where none is gathered
    std::vector<std::vector<Image>> lightmaps;   ///< by lightmap and layer, where they are gathered
    /// By layer, relative to its own light [-]: of what is gathered, else of what patches reflect.
    /// Not a number where it is not known.
    std::vector<double> errors;
    std::uint64_t rays = 0; ///< of all layers
};

/// Finds the light of each layer on patches. `solver` took the steps of the solution. Returns
/// nothing where the monitor ended it.
[[nodiscard]] std::optional<LampLight> light_of_lamps(const LitScene& scene,
                                                      const Solution& solution,
                                                      const KeepsRays& solver, LayersBy by,
                                                      Monitor& monitor);

/// Gathers the light of each layer as far as its share of the whole matters: all layers together
/// are as exact as the whole, which `asked` is of. `wanted` is of the whole, less what no layers
/// are wanted of. Returns whether it came to the end before the monitor ended it.
[[nodiscard]] bool gather_lamps(LampLight& light, const LitScene& scene, const Solution& solution,
                                const GatheredLight& whole, const WantedLight& wanted,
                                const Asked& asked, Monitor& monitor);

/// Returns the solution of a layer.
[[nodiscard]] Solution solution_of(const Solution& whole, const Relit& layer);

/// Makes the images of layers add up to that of the whole.
void add_up(const LampShares& shares, const Image& whole, std::span<Image> parts);

} // namespace hemilux
