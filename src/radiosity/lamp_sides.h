#pragma once
// Which way a lamp shines: to the side on which there is something to light.

#include "radiosity/shells.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace hemilux {

class Mesh;
class Tracer;

/// Whether a shell with emitting facets, once it is consistent (Shells::against), shines to its
/// backs. Empty where its surroundings do not tell, and where nothing of it emits.
///
/// In this order:
/// - A closed shell around which there is nothing lights its own inside: a furnace, an empty room.
/// - If one side alone lies before surfaces that do not shine themselves, it is this side; if there
///   are none, surfaces of other shells count.
/// - If both do and one of them is a wall at once, it is the other side. At once: eight times
///   nearer than what the other side sees and, if the shell is open, nearer than a third of the
///   lamp's size. So a lamp under a ceiling shines down, and one that is meant to light the ceiling
///   from some way below is left as it is.
[[nodiscard]] std::optional<bool> shines_to_backs(const Mesh& mesh, const Tracer& tracer,
                                                  const Shells& shells,
                                                  const std::vector<std::uint32_t>& shell_of,
                                                  std::uint32_t shell);

} // namespace hemilux
