#pragma once
// All kernels of one instruction set, as the files of kernels/ define them.

#include "radiosity/sampling/matrix_kernels.h"
#include "radiosity/sampling/sampling_kernels.h"

namespace hemilux {

struct KernelTable {
    SamplingKernels sampling;
    MatrixKernels matrix;
};

} // namespace hemilux
