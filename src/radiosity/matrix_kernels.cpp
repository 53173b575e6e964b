#include "radiosity/matrix_kernels.h"

#include "geometry/instruction_set.h"

namespace hemilux {

namespace sampling_baseline {
extern const MatrixKernels matrix;
}
namespace sampling_avx2 {
extern const MatrixKernels matrix;
}
namespace sampling_avx512 {
extern const MatrixKernels matrix;
}

const MatrixKernels& matrix_kernels(InstructionSet set) {
#if defined(HEMILUX_X86_KERNELS)
    if (set == InstructionSet::avx512)
        return sampling_avx512::matrix;
    if (set == InstructionSet::avx2)
        return sampling_avx2::matrix;
#else
    (void)set; // there is but one
#endif
    return sampling_baseline::matrix;
}

const MatrixKernels& matrix_kernels() {
    static const MatrixKernels& chosen = matrix_kernels(chosen_instruction_set());
    return chosen;
}

} // namespace hemilux
