#pragma once
// Loops over several threads whose result does not depend on their number. The caller writes to a
// place of its own for each index or chunk and sums in order, afterwards or meanwhile. Helping
// threads are started when they are first needed and then wait for more until the program ends.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace hemilux {

/// Calls work() on this thread and on up to `helpers` others, as far as these have nothing else to
/// do, and returns when all calls have returned. work() must not throw. Each call of it must handle
/// what the others leave, as perhaps no thread comes to help. work_together may be used from
/// several threads, and from within work() itself.
void work_together(std::size_t helpers, const std::function<void()>& work);

class Workers {
  public:
    /// Uses this many threads; 0: one per core.
    explicit Workers(unsigned threads)
        : threads_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

    [[nodiscard]] unsigned threads() const { return threads_; }

    /// Starts the helping threads while there is something else to do. Otherwise the first loop
    /// would wait until the system finds a processor for each.
    void start() const {
        for_chunks(threads_, 1, [](std::size_t, std::size_t) {});
    }

    /// Calls body(begin, end) for consecutive chunks of [0, count), each exactly once, on any
    /// thread. Rethrows the first exception of a body.
    template <class Body>
    void for_chunks(std::size_t count, std::size_t chunk, const Body& body) const {
        const std::size_t chunks = (count + chunk - 1) / chunk;
        std::atomic<std::size_t> next{0};
        std::exception_ptr failure;
        std::mutex failure_mutex;
        const auto work = [&] {
            try {
                for (std::size_t c = next++; c < chunks; c = next++)
                    body(c * chunk, std::min(count, (c + 1) * chunk));
            } catch (...) {
                const std::lock_guard lock(failure_mutex);
                if (!failure)
                    failure = std::current_exception();
                next = chunks;
            }
        };
        const std::size_t threads = std::min<std::size_t>(threads_, chunks);
        if (threads > 1)
            work_together(threads - 1, std::ref(work));
        else
            work();
        if (failure)
            std::rethrow_exception(failure);
    }

    /// Does the same with body(own, begin, end): each thread that takes part keeps what make()
    /// gives it, for all of its chunks.
    template <class Make, class Body>
    void for_chunks_with(std::size_t count, std::size_t chunk, const Make& make,
                         const Body& body) const {
        const std::size_t chunks = (count + chunk - 1) / chunk;
        std::atomic<std::size_t> next{0};
        for_chunks(std::min<std::size_t>(threads_, chunks), 1, [&](std::size_t, std::size_t) {
            std::size_t c = next++;
            if (c >= chunks)
                return;
            for (auto own = make(); c < chunks; c = next++)
                body(own, c * chunk, std::min(count, (c + 1) * chunk));
        });
    }

    /// Calls body(k) for each k in [0, count) on any thread, and take(k) once body(k) has returned.
    /// The calls of take come in the order of k, never two at a time, while others go on with their
    /// bodies.
    template <class Body, class Take>
    void for_each_in_order(std::size_t count, const Body& body, const Take& take) const {
        std::mutex mutex;
        std::vector<bool> done(count);
        std::size_t next = 0;
        bool taking = false;
        for_chunks(count, 1, [&](std::size_t k, std::size_t) {
            body(k);
            std::unique_lock lock(mutex);
            done[k] = true;
            if (taking)
                return;
            taking = true;
            for (; next < count && done[next]; ++next) {
                lock.unlock();
                take(next);
                lock.lock();
            }
            taking = false;
        });
    }

  private:
    unsigned threads_;
};

} // namespace hemilux
