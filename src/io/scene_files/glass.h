#pragma once
// Glass: materials that let light through as their files say, and the panes that are made of them.

#include "io/scene_files/read_result.h"

namespace hemilux {

/// Warns of the glass that was read: it is opaque as long as nobody opens it. Readers end with
/// this.
void warn_of_solid_glass(ReadResult& read);

/// Makes panes of the faces of glass, which are no facets any more, and replaces the warning. The
/// mean of the three channels comes through; a warning names glass of another colour than grey, and
/// glass that would reflect as well. Glass that emits stays opaque, with a warning.
void open_glass(ReadResult& read);

} // namespace hemilux
