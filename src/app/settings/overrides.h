#pragma once
// What the command line says about materials: `--emission lamp=10,10,8`, `--reflectance '*=.5'`.

#include "app/settings/numbers.h"
#include "radiosity/paper/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

/// A new value for the emission or reflectance of a material; `*` in its name stands for any
/// letters, and alone for all materials.
struct Override {
    std::string material;
    Vec3 value; ///< emission [W/m2], or reflectance [-]
};

inline constexpr NumberRange emission_range = non_negative;
inline constexpr NumberRange reflectance_range{.low = 0, .high = 1};

/// Returns whether the name is the pattern, where each * of it stands for any letters.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);

/// Reads "MATERIAL=R,G,B" or "MATERIAL=GREY"; empty for any other text.
[[nodiscard]] std::optional<Override> parse_override(std::string_view text,
                                                     const NumberRange& range);

/// Replaces the quantity and its texture in the materials named, in the order given. Throws
/// UsageError for a material that the scene does not have.
void apply_overrides(Scene& scene, Vec3 Material::*quantity,
                     const std::vector<Override>& overrides);

} // namespace hemilux
