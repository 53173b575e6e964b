#pragma once
// The instruction sets that kernels were compiled for. Kernels are written once and compiled for
// each set; the widest that the machine has is chosen at run time.

#include <span>
#include <string_view>

namespace hemilux {

enum class InstructionSet { baseline, avx2, avx512 };

/// Returns "baseline", "avx2" or "avx512".
[[nodiscard]] std::string_view name_of(InstructionSet set);

/// Returns the sets that are compiled in and that this machine can run; the widest first,
/// `baseline` last.
[[nodiscard]] std::span<const InstructionSet> available_instruction_sets();

/// Returns the set that the environment variable HEMILUX_KERNELS names if it is available, else the
/// widest.
[[nodiscard]] InstructionSet chosen_instruction_set();

} // namespace hemilux
