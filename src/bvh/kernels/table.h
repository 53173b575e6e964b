// All kernels of one instruction set, gathered for the choice at run time. The file that includes
// this names the set in HEMILUX_KERNELS.

#include "bvh/kernels/simd.h"

#include "bvh/kernels/sieve.h"

#include "bvh/kernels/stack.h"

#include "bvh/kernels/single.h"

#include "bvh/kernels/wave.h"

#include "bvh/kernels/pyramid.h"

#include "bvh/kernels/packet.h"

#include "bvh/kernels/shared_leaf.h"

#include "bvh/kernels/errands.h"

#include "bvh/kernels/bundle.h"

namespace hemilux::wide::HEMILUX_KERNELS {

extern const Kernels kernels;
const Kernels kernels{HEMILUX_KERNELS_NAME, closest,         occluded,       count,
                      closest_stream,       occluded_stream, closest_bundle, count_bundle};

} // namespace hemilux::wide::HEMILUX_KERNELS
