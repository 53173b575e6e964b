#pragma once
// Tells a solver to stop as soon as possible: its caller wishes it, or the time of the run is over.

#include <atomic>

namespace hemilux {

class SharedStop; // agreement of several processes (engine/solving/shared_stop.h)

class StopFlag {
  public:
    struct Reasons {
        std::atomic<bool> wished{false};      ///< wish of the caller, or of its signal handler
        std::atomic<bool> out_of_time{false}; ///< end of a time limit
    };

    StopFlag() = default;
    StopFlag(const StopFlag&) = delete;
    StopFlag& operator=(const StopFlag&) = delete;

    /// Returns whether the caller wishes it.
    [[nodiscard]] bool is_wished() const { return in_force_.load()->wished; }
    [[nodiscard]] bool is_out_of_time() const { return in_force_.load()->out_of_time; }
    /// Returns whether there is a reason to stop.
    explicit operator bool() const { return is_wished() || is_out_of_time(); }

    void set_wished(bool is_wished) { own_.wished = is_wished; }
    void set_out_of_time(bool is_over) { own_.out_of_time = is_over; }

    /// Returns the reasons of this process.
    [[nodiscard]] Reasons& own() { return own_; }
    [[nodiscard]] const Reasons& own() const { return own_; }

  private:
    friend class SharedStop;
    Reasons own_;
    mutable std::atomic<const Reasons*> in_force_{&own_};
    SharedStop* shared_ = nullptr;
};

} // namespace hemilux
