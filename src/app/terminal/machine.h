#pragma once
// The machine that a run is on, for reports of times.

#include <string>

namespace hemilux {

/// Returns the system, the processor as it names itself, how many of its threads there are, and the
/// instructions that the kernels use. What is not known is left out.
[[nodiscard]] std::string machine_text();

} // namespace hemilux
