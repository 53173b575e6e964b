#pragma once
// The processes that mpirun or srun has started together: one of them speaks and writes.

#include "parallel/ranks.h"

#include <string>

namespace hemilux {

/// This process among those that were started with it; alone where it was not.
class StartedRanks {
  public:
    /// All ranks but the first write nothing from now on, neither files nor text. Throws UsageError
    /// where several processes were started and the program has no module for MPI.
    StartedRanks();

    [[nodiscard]] const Ranks& ranks() const { return *ranks_; }
    /// Called by all ranks at the end: the exit code of the first.
    [[nodiscard]] int end(int code) const;
    /// Of a rank that cannot go on: ends all of them. What all ranks meet the first one says; what
    /// one alone meets is said with its number.
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
