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

/// Returns the share of all places [-] from which lit ones can be looked at: those of spaces to
/// which light finds its way. So a spot on a wide floor lights all of its space, and a lamp within
/// a closed case lights the case.
[[nodiscard]] double share_of_lit_spaces(const Mesh& mesh, const Tracer& tracer,
                                         const FreeSpace& free);

} // namespace hemilux
