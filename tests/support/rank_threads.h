#pragma once
// Ranks that are threads of one process: a whole run on several ranks within a test, with its
// counts of work and bytes.

#include "parallel/ranks.h"

#include <functional>

namespace hemilux {

/// Whether ranks share memory, as those of one machine do, or send everything.
enum class RankMemory { own, shared };

/// Calls body(rank) for each of `count` ranks, each on a thread of its own, and returns when all
/// have returned. Where one throws the others fail at their next call of Ranks, and its exception
/// is thrown here.
void run_as_ranks(unsigned count, const std::function<void(const Ranks&)>& body,
                  RankMemory memory = RankMemory::own);

} // namespace hemilux
