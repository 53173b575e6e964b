#pragma once
// What a library above the engine adds to the shooting methods. The engine is whole without any.
//
// Files of folders guides/ and aimers/ define an addition each, as those of methods/ define a
// method. The list of methods has theirs too (cmake/methods.cpp.in): where it is linked, they are
// there.

#include "radiosity/engine/shooting/aimer.h"
#include "radiosity/engine/shooting/guide.h"

#include <span>

namespace hemilux {

struct Additions {
    std::span<const Guide* const> guides = {}; ///< guides in the order of their places
    MakeAimer make_aimer = nullptr;            ///< nullptr: rays of steps cannot be aimed
};

/// Returns what was added; nothing at first.
[[nodiscard]] const Additions& additions();
/// Adds it, in place of what was there, before anything is solved. Always returns true.
bool add_to_engine(const Additions& added);

/// Returns whether methods whose rays can be aimed take a target, for Method::aims.
[[nodiscard]] bool has_aimer();

} // namespace hemilux
