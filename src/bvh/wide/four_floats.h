#pragma once
// Four floats at once for the code outside of the kernels, with what every machine has.

#define HEMILUX_KERNELS builder
#include "bvh/wide/kernels/simd.h"
#undef HEMILUX_KERNELS

namespace hemilux::wide {

using builder::F4;

} // namespace hemilux::wide
