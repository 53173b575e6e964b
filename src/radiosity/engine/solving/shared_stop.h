#pragma once
// Lets several ranks that solve one problem stop at the same place.

#include "parallel/ranks.h"
#include "radiosity/paper/solving/stop_flag.h"

namespace hemilux {

/// What a flag answers is, while this lives, what all ranks have agreed on last. A single rank
/// keeps its own flag.
class SharedStop {
  public:
    SharedStop(StopFlag& flag, const Ranks& ranks);
    ~SharedStop();
    SharedStop(const SharedStop&) = delete;
    SharedStop& operator=(const SharedStop&) = delete;

  private:
    friend class OnThisRank;
    friend const Ranks& ranks_of(const StopFlag& flag);
    friend const Ranks& ranks_at_work(const StopFlag& flag);
    friend bool agree(const StopFlag& flag);
    friend void end_time_limit(StopFlag& flag);

    [[nodiscard]] static SharedStop* of(const StopFlag& flag) { return flag.shared_; }
    static void set_aside(const StopFlag& flag) { flag.in_force_ = &flag.own_; }
    [[nodiscard]] static bool is_set_aside(const StopFlag& flag) {
        return flag.in_force_ == &flag.own_;
    }
    void put_in_force() const { flag_.in_force_ = &agreed_; }

    StopFlag& flag_;
    const Ranks& ranks_;
    StopFlag::Reasons agreed_;
};

/// Returns the ranks that share a flag; this one alone where it is not shared.
[[nodiscard]] const Ranks& ranks_of(const StopFlag& flag);
/// Returns true where one of the ranks that share the flag is to stop; all call it.
bool agree(const StopFlag& flag);
/// Takes back that the flag is out of time, whoever shares it.
void end_time_limit(StopFlag& flag);

/// Makes the flag that of this rank alone while it lives: for work that no other rank does, and
/// whose end all agree on afterwards.
class OnThisRank {
  public:
    explicit OnThisRank(const StopFlag& flag);
    ~OnThisRank();
    OnThisRank(const OnThisRank&) = delete;
    OnThisRank& operator=(const OnThisRank&) = delete;

  private:
    const SharedStop* shared_;
};

/// Returns the ranks that do together what the flag may stop: this one alone on OnThisRank.
[[nodiscard]] const Ranks& ranks_at_work(const StopFlag& flag);

} // namespace hemilux
