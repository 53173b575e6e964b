// All kernels of one instruction set, gathered for the choice at run time. The file that includes
// this names the set in HEMILUX_KERNELS.

#include "bvh/wide/kernels/simd.h"

#include "bvh/wide/kernels/conservative_test.h"

#include "bvh/wide/kernels/stack.h"

#include "bvh/wide/kernels/single.h"

#include "bvh/wide/kernels/interleaved.h"

namespace hemilux::wide::HEMILUX_KERNELS {

extern const Kernels kernels;
const Kernels kernels{closest, occluded, count, closest_stream, occluded_stream, count_stream};

} // namespace hemilux::wide::HEMILUX_KERNELS
