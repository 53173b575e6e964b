#pragma once
// Which way a lamp shines: to the side on which there is something to light.

#include "radiosity/sides/shells.h"

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

/// The side to which a shell with emitting facets shines; empty if its surroundings do not decide
/// it.
///
/// In this order:
/// - A closed shell around which there is nothing lights its own inside: a furnace, an empty room.
/// - If one side alone lies before surfaces that do not shine themselves, it is this side; if there
///   are none, surfaces of other shells count. Certain, unless this side is a wall at once: then it
///   may be a lamp on a roof that shines to the sky.
/// - If both do and one of them is a wall at once, it is the other side. At once: eight times
///   nearer than what the other side sees and, if the shell is open, nearer than a third of the
///   lamp's size; certain below a tenth. So a lamp under a ceiling shines down, and one that washes
///   a wall or lights the ceiling from some way below is left as it is.
[[nodiscard]] std::optional<EmitterSide> find_emitter_side(const Mesh& mesh, const Tracer& tracer,
                                                           const Targets& targets,
                                                           const Shells& shells,
                                                           std::uint32_t shell);

} // namespace hemilux
