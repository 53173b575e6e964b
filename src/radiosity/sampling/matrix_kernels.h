#pragma once
// The arithmetic of products with a sparse matrix: plain loops that the compiler turns into vector
// instructions, compiled once per instruction set (kernels/). All sets give the same bits, as every
// operation is rounded by itself. Plain data only: this header may define no function that the
// linker could merge.

#include <cstddef>
#include <cstdint>

namespace hemilux {

enum class InstructionSet; // parallel/instruction_set.h

struct MatrixEntry {
    std::uint32_t column;
    float value;
};

/// Three channels side by side, and a 0.
struct alignas(32) Lanes {
    double lane[4];
};

struct MatrixKernels {
    /// Sets `sum` to the sum of value times x[column] over the `count` entries of a row.
    void (*row_times)(const MatrixEntry* row, std::size_t count, const Lanes* x, Lanes* sum);
};

/// The kernels of an instruction set, which must be available.
[[nodiscard]] const MatrixKernels& matrix_kernels(InstructionSet set);
/// The kernels of the instruction set that was chosen.
[[nodiscard]] const MatrixKernels& matrix_kernels();

} // namespace hemilux
