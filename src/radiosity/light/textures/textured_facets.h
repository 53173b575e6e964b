#pragma once
// Computes the mean colours of parts of facets that carry textures.

#include "geometry/polygon.h"
#include "radiosity/paper/scene/scene.h"
#include "radiosity/paper/scene/varying_colours.h"

#include <cstdint>
#include <span>

namespace hemilux {

/// Returns the mean colours over a polygon on one half of a facet (Hit). Its `places` are
/// coordinates u and v along the half's edges from corner 0. The facet's material must carry a
/// texture.
[[nodiscard]] Colours colours_over(const Scene& scene, std::uint32_t facet, bool second_half,
                                   std::span<const Vec2> places);

/// Returns the mean colours over a convex part of a facet whose corners are `whole`.
[[nodiscard]] Colours mean_colours(const Scene& scene, std::uint32_t facet, const Polygon& whole,
                                   const Polygon& part);

/// Returns the colours of the texels at a point of a facet whose corners are `whole`.
[[nodiscard]] Colours colours_at_point(const Scene& scene, std::uint32_t facet,
                                       const Polygon& whole, const Vec3& point);

/// Returns what the texel of the reflectance covers at such a point [-] (Texture::set_cover); 1
/// where there is none.
[[nodiscard]] double cover_at_point(const Scene& scene, std::uint32_t facet, const Polygon& whole,
                                    const Vec3& point);

/// Gives each tinted material the mean of its emission over its facets.
void set_tinted_means(Scene& scene);

} // namespace hemilux
