// Which instruction set's kernels draw samples and multiply matrices.

#include "parallel/instruction_set.h"
#include "radiosity/sampling/kernel_table.h"

namespace hemilux {

namespace kernels_baseline {
extern const KernelTable table;
}
namespace kernels_avx2 {
extern const KernelTable table;
}
namespace kernels_avx512 {
extern const KernelTable table;
}

namespace {

const KernelTable& table_of(InstructionSet set) {
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

const KernelTable& chosen_table() {
    static const KernelTable& chosen = table_of(chosen_instruction_set());
    return chosen;
}

} // namespace

const SamplingKernels& sampling_kernels(InstructionSet set) { return table_of(set).sampling; }
const SamplingKernels& sampling_kernels() { return chosen_table().sampling; }
const MatrixKernels& matrix_kernels(InstructionSet set) { return table_of(set).matrix; }
const MatrixKernels& matrix_kernels() { return chosen_table().matrix; }

} // namespace hemilux
