// The kernels of samples and matrices for AVX-512.
#define HEMILUX_KERNELS kernels_avx512
#include "radiosity/engine/sampling/kernels/table.h"
