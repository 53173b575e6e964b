// The kernels of samples and matrices for AVX2.
#define HEMILUX_KERNELS kernels_avx2
#include "radiosity/engine/sampling/kernels/table.h"
