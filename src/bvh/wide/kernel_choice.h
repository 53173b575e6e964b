#pragma once
// The kernels of each instruction set.

#include "bvh/wide/wide_layout.h"
#include "parallel/instruction_set.h"

namespace hemilux::wide {

/// Returns the kernels of an instruction set, which must be available.
[[nodiscard]] const Kernels& kernels_of(InstructionSet set);

} // namespace hemilux::wide
