#pragma once
// Why a solver is to stop as soon as possible: its caller wishes it, or the time of the run is
// over.

#include <atomic>

namespace hemilux {

/// As std::atomic<bool> it holds the caller's wish alone, which a signal handler may set. Converted
/// to bool it is true for either reason.
class StopFlag : public std::atomic<bool> {
  public:
    StopFlag() : std::atomic<bool>(false) {}
    using std::atomic<bool>::operator=;

    operator bool() const { return load(std::memory_order_relaxed) || out_of_time(); }
    [[nodiscard]] bool out_of_time() const { return out_of_time_.load(std::memory_order_relaxed); }
    void set_out_of_time(bool is_over) { out_of_time_ = is_over; }

  private:
    std::atomic<bool> out_of_time_{false};
};

} // namespace hemilux
