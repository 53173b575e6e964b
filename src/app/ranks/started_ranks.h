#pragma once
// The processes that mpirun or srun has started together: one of them speaks and writes.

#include "parallel/ranks.h"

#include <string>

namespace hemilux {

/// This process among those that were started with it; alone where it was not.
class StartedRanks {
  public:
    /// Finds the ranks. All ranks but the first then write nothing, neither files nor text. Throws
    /// UsageError where several processes were started and the program has no module for MPI.
    StartedRanks();

    [[nodiscard]] const Ranks& ranks() const { return *ranks_; }
    /// Returns the exit code of the first rank. All ranks call this at the end.
    [[nodiscard]] int end(int code) const;
    /// Ends all ranks, where this one cannot go on. The first rank reports what all ranks meet; a
    /// rank that alone meets something reports it with its number.
    void fail(int code, const std::string& message) const;

  private:
    void load();
    void be_silent();

    const Ranks* ranks_ = &one_rank();
    int (*end_ranks_)(int code) = nullptr;
    void (*abort_ranks_)(int code) = nullptr;
    int errors_ = 2; ///< the descriptor for a message that must be said
};

} // namespace hemilux
