// Chooses which instruction set's kernels draw samples and multiply matrices.

#include "parallel/instruction_set.h"
#include "radiosity/engine/sampling/sampling_kernels.h"

namespace hemilux {

namespace kernels_baseline {
extern const SamplingKernels table;
}
namespace kernels_avx2 {
extern const SamplingKernels table;
}
namespace kernels_avx512 {
extern const SamplingKernels table;
}

const SamplingKernels& sampling_kernels(InstructionSet set) {
#if defined(HEMILUX_X86_KERNELS)
    if (set == InstructionSet::avx512)
        return kernels_avx512::table;
    if (set == InstructionSet::avx2)
        return kernels_avx2::table;
#else
    (void)set; // there is but one
#endif
    return kernels_baseline::table;
}

const SamplingKernels& sampling_kernels() {
    static const SamplingKernels& chosen = sampling_kernels(chosen_instruction_set());
    return chosen;
}

} // namespace hemilux
