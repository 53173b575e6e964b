#pragma once
// Memory that the ranks of one machine share.

#include "parallel/ranks.h"

#include <cstddef>
#include <memory>

namespace hemilux {

/// Returns memory that all ranks read and write. All ranks call this with as many bytes at the same
/// time, and the memory lasts until all have given it back. All get null where they are on several
/// machines, in containers that do not see each other's processes, or have no memory for it.
[[nodiscard]] std::shared_ptr<std::byte> memory_of_ranks(const Ranks& ranks, std::size_t bytes);

} // namespace hemilux
