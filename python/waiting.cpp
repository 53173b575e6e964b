#include "python/waiting.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace hemilux {
namespace {

namespace py = pybind11;

/// Work on a thread, and whether it is done.
class OwnThread {
  public:
    explicit OwnThread(const std::function<void()>& work)
        : thread_([this, &work] {
              try {
                  work();
              } catch (...) {
                  failure_ = std::current_exception();
              }
              {
                  const std::lock_guard lock(mutex_);
                  is_done_ = true;
              }
              end_.notify_one();
          }) {}

    /// Returns whether the work is done, after a tenth of a second at the latest.
    [[nodiscard]] bool is_done_soon() {
        constexpr std::chrono::milliseconds at_most{100};
        std::unique_lock lock(mutex_);
        return end_.wait_for(lock, at_most, [this] { return is_done_; });
    }
    void join() { thread_.join(); }
    [[nodiscard]] std::exception_ptr failure() const { return failure_; }

  private:
    std::mutex mutex_;
    std::condition_variable end_;
    bool is_done_ = false;
    std::exception_ptr failure_;
    std::thread thread_; ///< the last member: it uses the others
};

/// Throws what a signal handler of Python raises, or `progress` does.
void ask_python(const Monitor& monitor, const py::object& progress) {
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
    if (!progress.is_none())
        progress(monitor.phase.load(), monitor.step_share.load());
}

} // namespace

void run_without_lock(Monitor& monitor, const py::object& progress,
                      const std::function<void()>& work) {
    std::optional<py::error_already_set> raised;
    std::exception_ptr failure;
    {
        const py::gil_scoped_release unlocked;
        OwnThread thread(work);
        while (!thread.is_done_soon()) {
            if (raised)
                continue;
            const py::gil_scoped_acquire locked;
            try {
                ask_python(monitor, progress);
            } catch (py::error_already_set& error) {
                raised.emplace(error);
                monitor.interrupted.set_wished(true);
            }
        }
        thread.join();
        failure = thread.failure();
    }
    if (raised)
        throw py::error_already_set(*raised);
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace hemilux
