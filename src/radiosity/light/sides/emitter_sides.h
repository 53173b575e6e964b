#pragma once
// Finds which way an emitter shines: to the side on which there is something to light.

#include "radiosity/light/sides/shells.h"

#include <cstdint>
#include <optional>

namespace hemilux {

class Mesh;
class Targets;
class Tracer;

struct EmitterSide {
    bool back;    ///< it shines to its backs, once it is consistent (Shells::against)
    bool certain; ///< false where a file that is right elsewhere is to be believed
};

/// Finds the side to which a shell with emitting facets shines; empty if its surroundings do not
/// decide it.
///
/// These rules apply in turn:
/// - A closed shell around which there is nothing lights its own inside: a furnace, an empty room.
/// - If one side alone lies before surfaces that do not shine themselves, it is this side. If there
///   are none, surfaces of other shells count. The answer is certain, unless this side is a wall at
///   once: then the emitter may stand on a roof and shine to the sky.
/// - If both do and one of them is a wall at once, it is the other side. "At once" means eight
///   times nearer than what the other side sees. If the shell is open, it also means nearer than a
///   third of the emitter's size; the answer is certain below a tenth. So an emitter under a
///   ceiling shines down. One that washes a wall or lights the ceiling from some way below is left
///   as it is.
[[nodiscard]] std::optional<EmitterSide> find_emitter_side(const Mesh& mesh, const Tracer& tracer,
                                                           const Targets& targets,
                                                           const Shells& shells,
                                                           std::uint32_t shell);

} // namespace hemilux
