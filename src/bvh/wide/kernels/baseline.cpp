// The kernels for what the compiler takes without further flags.
#define HEMILUX_KERNELS baseline
#include "bvh/wide/kernels/table.h"
