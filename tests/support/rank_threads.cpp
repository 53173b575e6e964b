#include "support/rank_threads.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>

namespace hemilux {
namespace {

using Bytes = Ranks::Bytes;

/// What the ranks show each other, and where they wait until all have done so.
class Table {
  public:
    Table(unsigned count, RankMemory memory)
        : shown(count), shares_memory(memory == RankMemory::shared), count_(count) {}

    void wait_for_all() {
        std::unique_lock lock(mutex_);
        const std::uint64_t round = round_;
        if (++waiting_ == count_) {
            waiting_ = 0;
            ++round_;
            all_there_.notify_all();
        }
        all_there_.wait(lock, [&] { return round_ != round || failure_; });
        if (round_ == round)
            throw std::runtime_error("another rank has failed");
    }
    void fail(std::exception_ptr failure) {
        const std::lock_guard lock(mutex_);
        if (!failure_)
            failure_ = std::move(failure);
        all_there_.notify_all();
    }
    void rethrow_failure() const {
        if (failure_)
            std::rethrow_exception(failure_);
    }

    std::vector<std::vector<Bytes>> shown; ///< by rank
    bool shares_memory;
    std::shared_ptr<std::byte> shared; ///< of the first rank, for all

  private:
    unsigned count_, waiting_ = 0;
    std::uint64_t round_ = 0;
    std::exception_ptr failure_;
    std::mutex mutex_;
    std::condition_variable all_there_;
};

class RankThread final : public Ranks {
  public:
    RankThread(Table& table, unsigned index) : table_(table), index_(index) {}
    [[nodiscard]] unsigned count() const override {
        return static_cast<unsigned>(table_.shown.size());
    }
    [[nodiscard]] unsigned index() const override { return index_; }
    void wait_for_all() const override { table_.wait_for_all(); }
    [[nodiscard]] std::shared_ptr<std::byte> share_memory(std::size_t bytes) const override {
        if (!table_.shares_memory)
            return nullptr;
        constexpr std::align_val_t line{64};
        if (is_first())
            table_.shared = {static_cast<std::byte*>(operator new(bytes, line)),
                             [](std::byte* memory) { operator delete(memory, line); }};
        wait_for_all();
        const std::shared_ptr<std::byte> shared = table_.shared;
        wait_for_all();
        return shared;
    }

  private:
    void do_gather(std::span<const std::size_t> sizes, std::span<std::byte> all) const override {
        table_.shown[index_].assign(1, all);
        table_.wait_for_all();
        std::size_t place = 0;
        for (std::size_t r = 0; r < sizes.size(); place += sizes[r++])
            if (r != index_)
                std::ranges::copy(table_.shown[r][0].subspan(place, sizes[r]),
                                  all.subspan(place).begin());
        table_.wait_for_all();
    }
    void do_exchange(std::span<const Bytes> sent,
                     std::span<const std::span<std::byte>> received) const override {
        table_.shown[index_].assign(sent.begin(), sent.end());
        table_.wait_for_all();
        for (std::size_t r = 0; r < received.size(); ++r)
            std::ranges::copy(table_.shown[r][index_], received[r].begin());
        table_.wait_for_all();
    }

    Table& table_;
    unsigned index_;
};

} // namespace

void run_as_ranks(unsigned count, const std::function<void(const Ranks&)>& body,
                  RankMemory memory) {
    Table table(count, memory);
    {
        std::vector<std::jthread> threads;
        for (unsigned index = 0; index < count; ++index)
            threads.emplace_back([&table, &body, index] {
                try {
                    body(RankThread(table, index));
                } catch (...) {
                    table.fail(std::current_exception());
                }
            });
    }
    table.rethrow_failure();
}

} // namespace hemilux
