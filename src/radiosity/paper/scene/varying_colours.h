#pragma once
// Declares what a mesh asks of colours that vary over facets, as those of textures
// (radiosity/light/textures). Scenes of plain materials have none.

#include "geometry/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Mesh;
struct Patch;

struct Colours {
    Vec3 reflectance; ///< [-]
    Vec3 emission;    ///< [W/m2 leaving]
};

class VaryingColours {
  public:
    virtual ~VaryingColours() = default;
    /// Returns whether the colours of this material vary.
    [[nodiscard]] virtual bool on(std::uint32_t material) const = 0;
    /// Returns whether its emission does.
    [[nodiscard]] virtual bool emission_on(std::uint32_t material) const = 0;
    /// Returns the mean colours over each of these patches, whose materials vary. So many `threads`
    /// find them; 0 means one per core.
    [[nodiscard]] virtual std::vector<Colours>
    means(const Mesh& mesh, std::span<const std::uint32_t> patches, unsigned threads) const = 0;
    /// Returns the colours at a point (local frame) of a patch whose material varies.
    [[nodiscard]] virtual Colours at(const Mesh& mesh, const Patch& patch,
                                     const Vec3& point) const = 0;
};

/// Returns the colours at a point (local frame) of a patch: those of its material, or of textures.
[[nodiscard]] Colours colours_at(const Mesh& mesh, const Patch& patch, const Vec3& point);

} // namespace hemilux
