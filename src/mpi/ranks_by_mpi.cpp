#include "mpi/ranks_by_mpi.h"

#include "mpi/memory_of_ranks.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <mpi.h>
#include <thread>

namespace hemilux {
namespace {

/// The most bytes of one message, as MPI counts with int.
constexpr std::size_t max_bytes = std::size_t{1} << 30;

/// The ranks of MPI, which ends the program where one of its calls fails.
class RanksByMpi final : public Ranks {
  public:
    RanksByMpi() {
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
        MPI_Comm_rank(MPI_COMM_WORLD, &index_);
    }
    [[nodiscard]] unsigned count() const override { return static_cast<unsigned>(count_); }
    [[nodiscard]] unsigned index() const override { return static_cast<unsigned>(index_); }
    void wait_for_all() const override {
        std::atomic_thread_fence(std::memory_order_seq_cst);
        MPI_Barrier(MPI_COMM_WORLD);
        std::atomic_thread_fence(std::memory_order_seq_cst);
    }
    [[nodiscard]] std::shared_ptr<std::byte> share_memory(std::size_t bytes) const override {
        return memory_of_ranks(*this, bytes);
    }

  private:
    void do_gather(std::span<const std::size_t> sizes, std::span<std::byte> all) const override {
        const bool of_one = std::ranges::find(sizes, all.size()) != sizes.end();
        if (of_one || all.size() > max_bytes)
            return gather_in_turn(sizes, all);
        std::vector<int> counts, places;
        for (const std::size_t size : sizes) {
            places.push_back(places.empty() ? 0 : places.back() + counts.back());
            counts.push_back(static_cast<int>(size));
        }
        MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_BYTE, all.data(), counts.data(), places.data(),
                       MPI_BYTE, MPI_COMM_WORLD);
    }

    /// Gathers from one rank after the other, in messages that are not too long.
    void gather_in_turn(std::span<const std::size_t> sizes, std::span<std::byte> all) const {
        for (int rank = 0; rank < count_; ++rank) {
            const std::size_t size = sizes[static_cast<std::size_t>(rank)];
            for_messages(all.first(size), [&](std::byte* data, int bytes) {
                MPI_Bcast(data, bytes, MPI_BYTE, rank, MPI_COMM_WORLD);
            });
            all = all.subspan(size);
        }
    }

    void do_exchange(std::span<const Bytes> sent,
                     std::span<const std::span<std::byte>> received) const override {
        std::vector<MPI_Request> requests;
        for (int rank = 0; rank < count_; ++rank)
            for_messages(received[static_cast<std::size_t>(rank)], [&](std::byte* data, int bytes) {
                MPI_Irecv(data, bytes, MPI_BYTE, rank, 0, MPI_COMM_WORLD, &requests.emplace_back());
            });
        for (int k = 0; k < count_; ++k) { // all begin with another one
            const int rank = (index_ + k) % count_;
            for_messages(sent[static_cast<std::size_t>(rank)], [&](const std::byte* data,
                                                                   int bytes) {
                MPI_Isend(data, bytes, MPI_BYTE, rank, 0, MPI_COMM_WORLD, &requests.emplace_back());
            });
        }
        MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    }

    template <class Byte, class Body>
    static void for_messages(std::span<Byte> bytes, const Body& body) {
        for (std::size_t at = 0; at < bytes.size(); at += max_bytes)
            body(&bytes[at], static_cast<int>(std::min(max_bytes, bytes.size() - at)));
    }

    int count_ = 1, index_ = 0;
};

std::unique_ptr<RanksByMpi> ranks;

} // namespace
} // namespace hemilux

extern "C" const hemilux::Ranks* hemilux_start_ranks() {
    // This setting is for Open MPI: a rank that waits leaves the processor to those that have work.
    // A setting by the user takes precedence.
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    int provided = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
        provided < MPI_THREAD_FUNNELED)
        return nullptr;
    hemilux::ranks = std::make_unique<hemilux::RanksByMpi>();
    return hemilux::ranks.get();
}

extern "C" int hemilux_end_ranks(int code) {
    constexpr auto pause = std::chrono::milliseconds(5); // MPI itself would look without end
    MPI_Request of_first = MPI_REQUEST_NULL;
    MPI_Ibcast(&code, 1, MPI_INT, 0, MPI_COMM_WORLD, &of_first);
    for (int is_there = 0; MPI_Test(&of_first, &is_there, MPI_STATUS_IGNORE), !is_there;)
        std::this_thread::sleep_for(pause);
    hemilux::ranks.reset();
    MPI_Finalize();
    return code;
}

extern "C" void hemilux_abort_ranks(int code) { MPI_Abort(MPI_COMM_WORLD, code); }
