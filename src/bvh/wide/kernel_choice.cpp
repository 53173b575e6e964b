#include "bvh/wide/kernel_choice.h"

namespace hemilux::wide {

namespace baseline {
extern const Kernels kernels;
}
namespace avx2 {
extern const Kernels kernels;
}
namespace avx512 {
extern const Kernels kernels;
}

const Kernels& kernels_of(InstructionSet set) {
#if defined(HEMILUX_X86_KERNELS)
    if (set == InstructionSet::avx512)
        return avx512::kernels;
    if (set == InstructionSet::avx2)
        return avx2::kernels;
#else
    (void)set; // there is but one
#endif
    return baseline::kernels;
}

} // namespace hemilux::wide
