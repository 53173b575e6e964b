#pragma once
// Tells a solver to stop as soon as possible: its caller wishes it, or the time of the run is over.

#include <atomic>

namespace hemilux {

class StopFlag {
  public:
    struct Reasons {
        std::atomic<bool> wished{false};      ///< wish of the caller, or of its signal handler
        std::atomic<bool> out_of_time{false}; ///< end of a time limit
    };
    /// The reasons on which several processes have agreed, so that all stop at the same place
    /// (engine/solving/shared_stop.h).
    struct Agreed {
        Reasons reasons;
        std::atomic<bool> is_set_aside{false}; ///< the flag's own reasons decide for now
    };

    StopFlag() = default;
    StopFlag(const StopFlag&) = delete;
    StopFlag& operator=(const StopFlag&) = delete;

    /// Returns whether the caller wishes it.
    [[nodiscard]] bool is_wished() const { return in_force().wished; }
    [[nodiscard]] bool is_out_of_time() const { return in_force().out_of_time; }
    /// Returns whether there is a reason to stop.
    explicit operator bool() const { return is_wished() || is_out_of_time(); }

    void set_wished(bool is_wished) { own_.wished = is_wished; }
    void set_out_of_time(bool is_over) {
        own_.out_of_time = is_over;
        if (agreed_ && !is_over)
            agreed_->reasons.out_of_time = false;
    }

    /// Returns the reasons of this process.
    [[nodiscard]] Reasons& own() { return own_; }
    [[nodiscard]] const Reasons& own() const { return own_; }
    /// Lets agreed reasons, which outlive this use, decide in place of its own; nullptr: its own.
    void decide_by(Agreed* agreed) { agreed_ = agreed; }
    [[nodiscard]] Agreed* agreed() const { return agreed_; }

  private:
    [[nodiscard]] const Reasons& in_force() const {
        return agreed_ && !agreed_->is_set_aside ? agreed_->reasons : own_;
    }

    Reasons own_;
    Agreed* agreed_ = nullptr;
};

} // namespace hemilux
