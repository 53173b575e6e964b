#pragma once
// Finds out, by a quick look, at which places of a scene any light arrives.

#include "radiosity/light/rooms/free_space.h"

#include <span>

namespace hemilux {

/// Returns the share of the places [-] to which light finds its way, straight or by up to three
/// reflections. From each place it follows eight random paths and looks from each of their points
/// towards one emitter, drawn by its power. A place counts where one of them finds light; so the
/// share is somewhat too small where most of the light is hidden. It is 0 where nothing emits.
[[nodiscard]] double share_reached_by_light(const Mesh& mesh, const Tracer& tracer,
                                            std::span<const SeenPlace> places);

} // namespace hemilux
