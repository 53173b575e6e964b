#pragma once
// Checks whether there is anything to solve: what each method asks before it begins.

#include "geometry/vector.h"
#include "radiosity/paper/solution/solution.h"

namespace hemilux {

struct SolverInput;

/// Returns whether each channel is in [0,1]; NaN is not.
[[nodiscard]] bool is_reflectance(const Vec3& r);

/// Returns what is known before the first step: the emission, which is still to be shot. Standard
/// errors are NaN, or 0 where no light can be reflected. Throws SolveError
/// - where a patch has a reflectance outside of [0,1] or an emission that is negative or not
///   finite,
/// - where emitted powers overflow or are too small to be squared,
/// - and where light is trapped between surfaces of reflectance 1 (lossless_component.h).
[[nodiscard]] Solution solution_before_steps(const SolverInput& input);

} // namespace hemilux
