#include "radiosity/sampling_kernels.h"

#include "geometry/instruction_set.h"

namespace hemilux {

namespace sampling_baseline {
extern const SamplingKernels sampling;
}
namespace sampling_avx2 {
extern const SamplingKernels sampling;
}
namespace sampling_avx512 {
extern const SamplingKernels sampling;
}

const SamplingKernels& sampling_kernels(InstructionSet set) {
#if defined(HEMILUX_X86_KERNELS)
    if (set == InstructionSet::avx512)
        return sampling_avx512::sampling;
    if (set == InstructionSet::avx2)
        return sampling_avx2::sampling;
#else
    (void)set; // there is but one
#endif
    return sampling_baseline::sampling;
}

const SamplingKernels& sampling_kernels() {
    static const SamplingKernels& chosen = sampling_kernels(chosen_instruction_set());
    return chosen;
}

} // namespace hemilux
