// The sampling kernels for AVX2.
#define HEMILUX_KERNELS sampling_avx2
#include "radiosity/kernels/table.h"
