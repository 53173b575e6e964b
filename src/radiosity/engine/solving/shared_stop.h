#pragma once
// Lets several ranks that solve one problem stop at the same place.

#include "parallel/ranks.h"
#include "radiosity/paper/solving/stop_flag.h"

namespace hemilux {

/// What a flag answers is, while this lives, what all ranks have agreed on last. A single rank
/// keeps its own flag. The flag and the ranks outlive this.
class SharedStop : private StopFlag::Agreed {
  public:
    SharedStop(StopFlag& flag, const Ranks& ranks);
    ~SharedStop();
    SharedStop(const SharedStop&) = delete;
    SharedStop& operator=(const SharedStop&) = delete;

  private:
    friend const Ranks& ranks_of(const StopFlag& flag);
    friend bool agree(const StopFlag& flag);

    StopFlag& flag_;
    const Ranks& ranks_;
};

/// Returns the ranks that share a flag; this one alone where it is not shared.
[[nodiscard]] const Ranks& ranks_of(const StopFlag& flag);
/// Returns true where one of the ranks that share the flag is to stop; all call it.
bool agree(const StopFlag& flag);

/// Makes the flag that of this rank alone while it lives: for work that no other rank does, and
/// whose end all agree on afterwards.
class OnThisRank {
  public:
    explicit OnThisRank(const StopFlag& flag);
    ~OnThisRank();
    OnThisRank(const OnThisRank&) = delete;
    OnThisRank& operator=(const OnThisRank&) = delete;

  private:
    StopFlag::Agreed* agreed_;
};

/// Returns the ranks that do together what the flag may stop: this one alone on OnThisRank.
[[nodiscard]] const Ranks& ranks_at_work(const StopFlag& flag);

} // namespace hemilux
