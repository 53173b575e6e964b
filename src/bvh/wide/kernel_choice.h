#pragma once
// Which instruction set's kernels are used: the widest that the machine has.

#include "bvh/wide/wide_layout.h"

#include <span>
#include <string_view>

namespace hemilux::wide {

/// Those that were compiled in and that this machine can run; the widest first, `baseline` last.
[[nodiscard]] std::span<const Kernels* const> available_kernels();

/// By name; "" is the environment variable HEMILUX_KERNELS if it names one that is available, else
/// the widest. Throws std::invalid_argument when there is none of that name.
[[nodiscard]] const Kernels& find_kernels(std::string_view name);

} // namespace hemilux::wide
