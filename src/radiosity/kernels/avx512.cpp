// The sampling kernels for AVX-512.
#define HEMILUX_KERNELS sampling_avx512
#include "radiosity/kernels/table.h"
