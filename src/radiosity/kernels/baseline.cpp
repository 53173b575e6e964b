// The sampling kernels for any machine.
#define HEMILUX_KERNELS sampling_baseline
#include "radiosity/kernels/table.h"
