#pragma once
// A lightmap of gathered light.

#include "radiosity/answers/gathering/gatherer.h"
#include "radiosity/answers/lightmaps/lightmap_layout.h"
#include "radiosity/answers/vertices/baked_light.h"

#include <cstdint>
#include <optional>
#include <string>

namespace hemilux {

/// A lightmap that is wanted, of an object of this name or, without one, of all. The layout lives
/// as long as it is gathered.
struct WantedLightmap {
    std::string object;
    const LightmapLayout& layout;
    Bake bake = Bake::radiosity;
    std::uint64_t number = 0; ///< of several, from 0: each has random numbers of its own
};

struct LightOfLightmap {
    Image image; ///< [W/m2]
    TargetLevel level;
    std::uint64_t texels = 0; ///< that were gathered
    unsigned rays = 0;        ///< at each of them
    int rows = 0;             ///< finished, from the first
    bool is_complete = false; ///< all rows are; otherwise the others have the light of patches
};

/// Returns a lightmap. A signal leaves the light of the patches in the rows that are not gathered.
[[nodiscard]] Answer<LightOfLightmap> gather_lightmap(Gatherer& gatherer,
                                                      const WantedLightmap& lightmap,
                                                      const std::optional<WholeLight>& whole = {});

/// Returns what is said where a signal left such a lightmap.
[[nodiscard]] std::string end_text(const std::string& object, const LightOfLightmap& lightmap);

} // namespace hemilux
