#pragma once
// Finds faces that look away from the light, as those of a room modelled from outside do.
//
// Facets are gathered into shells (shells.h). The front of a shell follows from where emitters find
// something to light (emitter_sides.h) and from where light arrives (light_paths.h). A surface may
// be meant to be lit from behind, as a lamp shade is that faces outwards. So these rules apply:
// - A closed shell is turned if nearly all of its light falls on its backs, and an emitter if it
//   faces a wall at once or nothing. If its facets disagree, some are turned first.
// - An open shell is turned only if the file is disordered: reversed as a whole or in many of its
//   faces. Then its backs need more light than its fronts. In a file that is right elsewhere only a
//   few faces are turned, those that disagree with a large shell.
// - Anything else that gets nearly all of its light on its backs stays, and is counted as in doubt.

#include "radiosity/light/sides/light_paths.h"
#include "radiosity/paper/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

struct Orientation {
    std::vector<bool> looks_away;      ///< marks by face of the file; empty where none does
    std::size_t faces = 0;             ///< faces that look away
    std::vector<std::uint32_t> groups; ///< groups of these faces, ascending
    std::size_t inside_out = 0;        ///< closed shells that do not emit, as a whole
    std::size_t from_behind = 0;       ///< open shells that do not emit, as a whole
    std::size_t emitters = 0;          ///< shells that emit, as a whole
    std::size_t mixed = 0;             ///< shells of which some faces look away
    std::size_t clashing_edges = 0;    ///< edges that two facets run along in the same direction
    std::size_t one_sided = 0;         ///< shells that cannot be oriented: Moebius strips
    LightShares light;                 ///< light with the faces as they are, if some look away
    std::size_t in_doubt = 0; ///< faces that stay, although much light falls on their backs
    std::vector<std::uint32_t> groups_in_doubt; ///< ascending
};

/// Finds the faces that look away; the same mesh gives the same faces. In a scene without an
/// emitter, or with a sun and a sky alone, there are none. Two-sided facets never look away.
[[nodiscard]] Orientation find_orientation(const Mesh& mesh, const Tracer& tracer);
/// Finds them with a mesh and a tracer that it makes itself. It finds `light` in any case.
[[nodiscard]] Orientation find_orientation(const Scene& scene);

/// Turns all faces that look away.
void turn_faces(Scene& scene, const Orientation& orientation);

} // namespace hemilux
