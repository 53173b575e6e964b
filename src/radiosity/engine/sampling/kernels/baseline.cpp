// The kernels of samples and matrices for any machine.
#define HEMILUX_KERNELS kernels_baseline
#include "radiosity/engine/sampling/kernels/table.h"
