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
    std::string object; ///< WantedLightmap::object
    Image image;        ///< [W/m2]
    TargetLevel level;
    std::uint64_t texels = 0; ///< that were gathered
    unsigned rays = 0;        ///< at each of them
    int rows = 0;             ///< gathered, from the first; the others have the light of patches

    [[nodiscard]] bool is_complete() const { return rows == image.height; }
};

/// Returns a lightmap. A signal leaves the light of the patches in the rows that are not gathered.
[[nodiscard]] Answer<LightOfLightmap> gather_lightmap(Gatherer& gatherer,
                                                      const WantedLightmap& lightmap,
                                                      const std::optional<WholeLight>& whole = {});

/// Returns what is said where a signal left such a lightmap.
[[nodiscard]] std::string end_text(const LightOfLightmap& lightmap);

} // namespace hemilux
