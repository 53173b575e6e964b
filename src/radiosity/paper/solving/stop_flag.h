#pragma once
// Tells a solver to stop as soon as possible: its caller wishes it, or the time of the run is over.

#include "parallel/ranks.h"

#include <algorithm>
#include <atomic>

namespace hemilux {

/// A flag with two reasons to stop. As std::atomic<bool> it holds the caller's wish alone, which a
/// signal handler may set. Converted to bool it is true for either reason.
///
/// Where several ranks solve one problem each has a flag, and all must stop at the same place. The
/// flag is then true from the next call of agree() on.
class StopFlag : public std::atomic<bool> {
  public:
    StopFlag() : std::atomic<bool>(false) {}
    using std::atomic<bool>::operator=;

    operator bool() const { return wished() || out_of_time(); }
    /// Returns whether the caller wishes it.
    [[nodiscard]] bool wished() const { return is_own() ? own_wish() : agreed_wish_.load(); }
    [[nodiscard]] bool out_of_time() const {
        return (is_own() ? out_of_time_ : agreed_time_).load();
    }
    void set_out_of_time(bool is_over) {
        out_of_time_ = is_over;
        agreed_time_ = agreed_time_ && is_over;
    }

    /// Makes it a flag of these ranks.
    void share(const Ranks& ranks) { ranks_ = ranks.are_several() ? &ranks : nullptr; }
    /// Returns the ranks that do together what it may stop: this one alone, unless the flag is
    /// shared.
    [[nodiscard]] const Ranks& ranks() const { return is_own() ? one_rank() : *ranks_; }
    /// Returns true where one of the ranks is to stop; all call it. A single rank gets its own
    /// flag.
    bool agree() const {
        if (ranks_) {
            const auto of_ranks = ranks_->of_each(Reasons{own_wish(), out_of_time_});
            agreed_wish_ = std::ranges::any_of(of_ranks, &Reasons::wish);
            agreed_time_ = std::ranges::any_of(of_ranks, &Reasons::time);
        }
        return *this;
    }

    /// Makes the flag that of this rank alone while it lives: for work that no other rank does, and
    /// whose end all agree on afterwards.
    class OfThisRank {
      public:
        explicit OfThisRank(const StopFlag& flag) : flag_(flag) { flag_.is_of_this_rank_ = true; }
        ~OfThisRank() { flag_.is_of_this_rank_ = false; }
        OfThisRank(const OfThisRank&) = delete;
        OfThisRank& operator=(const OfThisRank&) = delete;

      private:
        const StopFlag& flag_;
    };

  private:
    struct Reasons {
        bool wish, time;
    };
    [[nodiscard]] bool own_wish() const { return load(std::memory_order_relaxed); }
    [[nodiscard]] bool is_own() const { return !ranks_ || is_of_this_rank_; }

    std::atomic<bool> out_of_time_{false};
    const Ranks* ranks_ = nullptr; ///< nullptr: one alone
    mutable std::atomic<bool> agreed_wish_{false}, agreed_time_{false};
    mutable std::atomic<bool> is_of_this_rank_{false};
};

} // namespace hemilux
