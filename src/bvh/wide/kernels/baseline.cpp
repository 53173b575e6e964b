// The kernels for what the compiler takes without being told more.
#define HEMILUX_KERNELS baseline
#include "bvh/wide/kernels/table.h"
