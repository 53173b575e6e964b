// The kernels for AVX2 with FMA.
#define HEMILUX_KERNELS avx2
#include "bvh/wide/kernels/table.h"
