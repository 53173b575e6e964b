// The kernels for AVX-512 (F, DQ, BW, VL).
#define HEMILUX_KERNELS avx512
#include "bvh/wide/kernels/table.h"
