#pragma once
// Faces that look away from the light, as those of a room modelled from outside do.
//
// Facets are gathered into shells (shells.h). Which side of a shell is its front follows from where
// lamps find something to light (lamp_sides.h) and from where light arrives (lit_sides.h). What the
// evidence leaves open stays as it is:
// - A shell whose fronts get nearly all of its light stays, and so does one without light.
// - A consistent shell is turned as a whole, and only if nearly all of its light falls on its
//   backs. For an open one that is a stricter limit: more of them are meant to be lit from behind.
// - In a shell whose facets do not agree, those faces are turned that are in the minority, or unlit
//   where the others are lit. Faces on whose fronts most of their own light falls stay.

#include "radiosity/light_shares.h"
#include "radiosity/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

struct Orientation {
    std::vector<bool> looks_away;      ///< by face of the file; empty where none does
    std::size_t faces = 0;             ///< that look away
    std::vector<std::uint32_t> groups; ///< of these faces, ascending
    std::size_t inside_out = 0;        ///< closed shells without a lamp, as a whole
    std::size_t from_behind = 0;       ///< open shells without a lamp, as a whole
    std::size_t lamps = 0;             ///< shells with a lamp, as a whole
    std::size_t mixed = 0;             ///< shells of which some faces look away
    std::size_t clashing_edges = 0;    ///< that two facets run along in the same direction
    std::size_t one_sided = 0;         ///< shells that cannot be oriented: Moebius strips
    LightShares light;                 ///< with the faces as they are
};

/// Deterministic. In a scene in which nothing emits no face looks away. `threads`: 0 for one per
/// core; the result does not depend on it.
[[nodiscard]] Orientation find_orientation(const Scene& scene, unsigned threads = 0);

/// Turns all faces that look away.
void turn_faces(Scene& scene, const Orientation& orientation);

} // namespace hemilux
