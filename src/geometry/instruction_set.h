#pragma once
// Which of the instruction sets that kernels were compiled for this machine has. Kernels are
// written once and compiled for each of these; the widest is taken at run time.

#include <span>
#include <string_view>

namespace hemilux {

enum class InstructionSet { baseline, avx2, avx512 };

/// "baseline", "avx2", "avx512"
[[nodiscard]] std::string_view name_of(InstructionSet set);

/// Those that were compiled in and that this machine can run; the widest first, `baseline` last.
[[nodiscard]] std::span<const InstructionSet> available_instruction_sets();

/// The environment variable HEMILUX_KERNELS if it names one that is available, else the widest.
[[nodiscard]] InstructionSet chosen_instruction_set();

} // namespace hemilux
