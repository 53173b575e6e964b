#include "parallel/workers.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace hemilux {
namespace {

/// Checks a condition for as long as waking a sleeping thread would take; true once it holds.
template <class Condition>
bool holds_soon(const Condition& condition) {
    constexpr int looks = 2000, patient = 64;
    for (int k = 0; k < looks; ++k) {
        if (condition())
            return true;
        if (k % patient == patient - 1)
            std::this_thread::yield(); // to one who has work, if there are too few cores
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#endif
    }
    return false;
}

/// A call of work_together, which lives until no helper is inside.
struct Job {
    FunctionRef<void()> work;
    std::size_t wanted;                 ///< helpers that may still come
    std::atomic<std::size_t> inside{0}; ///< helpers
};

class Pool {
  public:
    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        posted_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }

    void run(Job& job) {
        post(job);
        job.work();
        withdraw(job);
        const auto left_alone = [&] { return job.inside.load(std::memory_order_acquire) == 0; };
        if (holds_soon(left_alone))
            return;
        std::unique_lock lock(mutex_);
        left_.wait(lock, left_alone);
    }

  private:
    void post(Job& job) {
        std::size_t wake = 0;
        {
            const std::lock_guard lock(mutex_);
            start_threads(job.wanted);
            jobs_.push_back(&job);
            open_jobs_.store(jobs_.size(), std::memory_order_relaxed);
            wake = std::min(job.wanted, sleeping_);
        }
        for (; wake > 0; --wake)
            posted_.notify_one();
    }

    void withdraw(Job& job) {
        const std::lock_guard lock(mutex_);
        std::erase(jobs_, &job);
        open_jobs_.store(jobs_.size(), std::memory_order_relaxed);
    }

    /// Starts as many threads as any job has wanted. If the system refuses, there are fewer.
    void start_threads(std::size_t wanted) {
        try {
            while (threads_.size() < wanted)
                threads_.emplace_back([this] { help(); });
        } catch (const std::system_error&) {
        }
    }

    void help() {
        std::unique_lock lock(mutex_);
        while (!ending_) {
            if (!jobs_.empty()) {
                help_with(*jobs_.back(), lock); // the innermost, for which others wait
                continue;
            }
            lock.unlock();
            const bool soon =
                holds_soon([&] { return open_jobs_.load(std::memory_order_relaxed) > 0; });
            lock.lock();
            if (soon)
                continue;
            ++sleeping_;
            posted_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
            --sleeping_;
        }
    }

    void help_with(Job& job, std::unique_lock<std::mutex>& lock) {
        ++job.inside;
        if (--job.wanted == 0) {
            std::erase(jobs_, &job);
            open_jobs_.store(jobs_.size(), std::memory_order_relaxed);
        }
        lock.unlock();
        job.work();
        lock.lock();
        if (job.inside.fetch_sub(1, std::memory_order_release) == 1) // the job may be gone now
            left_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable posted_, left_;
    std::vector<Job*> jobs_; ///< jobs that want helpers
    std::atomic<std::size_t> open_jobs_{0};
    std::size_t sleeping_ = 0;
    bool ending_ = false;
    std::vector<std::thread> threads_;
};

} // namespace

void work_together(std::size_t helpers, FunctionRef<void()> work) {
    static Pool pool;
    Job job{work, helpers};
    pool.run(job);
}

Workers::Workers(unsigned threads)
    : threads_(threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

void Workers::start() const {
    for_chunks(threads_, 1, [](std::size_t, std::size_t) {});
}

void Workers::for_chunks(std::size_t count, std::size_t chunk,
                         FunctionRef<void(std::size_t, std::size_t)> body) const {
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
        work_together(threads - 1, work);
    else
        work();
    if (failure)
        std::rethrow_exception(failure);
}

void Workers::for_takers(std::size_t count, std::size_t chunk,
                         FunctionRef<void(TakeChunk)> body) const {
    const std::size_t chunks = (count + chunk - 1) / chunk;
    std::atomic<std::size_t> taken{0};
    const auto take = [&](Chunk& next) {
        const std::size_t c = taken++;
        next = {c * chunk, std::min(count, (c + 1) * chunk)};
        return c < chunks;
    };
    for_chunks(std::min<std::size_t>(threads_, chunks), 1,
               [&](std::size_t, std::size_t) { body(take); });
}

void Workers::for_each_in_order(std::size_t count, FunctionRef<void(std::size_t)> body,
                                FunctionRef<void(std::size_t)> take) const {
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

} // namespace hemilux
