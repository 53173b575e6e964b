#pragma once
// Several processes that solve one problem, as MPI starts them. Each is a rank, runs the same
// program on the same input, and owns a part of what is large.
//
// The result does not depend on their number: what a rank computes is gathered as it is, and each
// adds numbers in the same order. Nothing here adds floating-point numbers.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace hemilux {

/// The work that a rank has done for the run so far.
struct RankWork {
    std::uint64_t rays = 0;    ///< traced
    std::uint64_t entries = 0; ///< entries of matrices, each as often as it was multiplied
    std::uint64_t sent = 0, received = 0; ///< bytes
};

/// This rank, and its way to the others. All ranks call the same functions in the same order, each
/// from one thread at a time; every call waits for the others. Throws std::runtime_error where
/// another rank has failed.
class Ranks {
  public:
    using Bytes = std::span<const std::byte>;

    Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    virtual ~Ranks() = default;

    [[nodiscard]] virtual unsigned count() const = 0;
    /// Returns the number of this rank, below count().
    [[nodiscard]] virtual unsigned index() const = 0;
    [[nodiscard]] bool are_several() const { return count() > 1; }
    [[nodiscard]] bool is_first() const { return index() == 0; }

    /// Gathers `all`, the bytes of all ranks one after the other, with sizes[r] bytes of rank r.
    /// Each rank has written its own; afterwards all ranks have all.
    void gather(std::span<const std::size_t> sizes, std::span<std::byte> all) const;
    /// Gives the items of one rank to all. All ranks pass as many items.
    template <class T>
    void give_to_all(unsigned rank, std::span<T> items) const;
    /// Returns the value of each rank.
    template <class T>
    [[nodiscard]] std::vector<T> of_each(const T& value) const;
    /// Returns the value of the first rank; what depends on a clock is decided there.
    template <class T>
    [[nodiscard]] T of_first(T value) const {
        give_to_all(0, std::span(&value, 1));
        return value;
    }
    /// Returns whether the value is true on some rank.
    [[nodiscard]] bool any(bool value) const;
    [[nodiscard]] bool all(bool value) const { return !any(!value); }
    [[nodiscard]] std::uint64_t sum(std::uint64_t value) const;
    /// Sends sent[r] to rank r; returns what each has sent to this one.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>>
    exchange(const std::vector<std::vector<T>>& sent) const;

    /// Returns when all ranks have called it. Each then sees what the others wrote to memory that
    /// they share.
    virtual void wait_for_all() const = 0;
    /// Returns memory that all ranks read and write, where they are on one machine; else null. All
    /// ask for as many bytes at the same time.
    [[nodiscard]] virtual std::shared_ptr<std::byte> share_memory(std::size_t /*bytes*/) const {
        return nullptr;
    }

    /// Counts work that this rank has done.
    void add_work(std::uint64_t rays, std::uint64_t entries) const {
        rays_ += rays;
        entries_ += entries;
    }
    [[nodiscard]] RankWork work() const { return {rays_, entries_, sent_, received_}; }

  private:
    virtual void do_gather(std::span<const std::size_t> sizes, std::span<std::byte> all) const = 0;
    virtual void do_exchange(std::span<const Bytes> sent,
                             std::span<const std::span<std::byte>> received) const = 0;
    void exchange_bytes(std::span<const Bytes> sent,
                        std::span<const std::span<std::byte>> received) const;

    mutable std::atomic<std::uint64_t> rays_{0}, entries_{0}, sent_{0}, received_{0};
};

/// Returns the only rank of a program that runs alone.
[[nodiscard]] const Ranks& one_rank();

/// Items in blocks that belong to the ranks in turn. What is known of each item is kept by all
/// ranks; the owner alone keeps what takes more memory or time than that.
class OwnBlocks {
  public:
    /// All blocks but the last are multiples of this, unless their length is given.
    static constexpr std::size_t min_block = 64;
    /// Divides the items.
    OwnBlocks(const Ranks& ranks, std::size_t items)
        : OwnBlocks(ranks, items, usual_block(items / ranks.count())) {}
    OwnBlocks(const Ranks& ranks, std::size_t items, std::size_t block)
        : ranks_(&ranks), count_(ranks.count()), index_(ranks.index()), all_(items), block_(block),
          own_(items_of(index_)) {}

    [[nodiscard]] const Ranks& ranks() const { return *ranks_; }
    /// Returns the number of items of all ranks.
    [[nodiscard]] std::size_t items() const { return all_; }
    /// Returns the number of items of a block.
    [[nodiscard]] std::size_t block() const { return block_; }
    [[nodiscard]] bool are_all() const { return own_ == all_; }
    [[nodiscard]] unsigned owner(std::size_t item) const {
        return static_cast<unsigned>(item / block_ % count_);
    }
    [[nodiscard]] bool owns(std::size_t item) const { return are_all() || owner(item) == index_; }
    /// Returns the number of this rank's own items.
    [[nodiscard]] std::size_t count() const { return own_; }
    /// Returns the own item at place `k` among them. Those of a block follow each other.
    [[nodiscard]] std::size_t item(std::size_t k) const {
        return (k / block_ * count_ + index_) * block_ + k % block_;
    }
    [[nodiscard]] std::size_t items_of(std::size_t rank) const;

    /// Gathers the items that each rank has written, with `of_item` values of each; afterwards all
    /// ranks have all.
    template <class T>
    void gather(std::span<T> values, std::size_t of_item = 1) const {
        static_assert(std::is_trivially_copyable_v<T>);
        if (ranks_->are_several())
            gather_bytes(std::as_writable_bytes(values), of_item * sizeof(T));
    }
    template <class T>
    void gather(std::vector<T>& values, std::size_t of_item = 1) const {
        gather(std::span(values), of_item);
    }

  private:
    /// Returns a block length at which each rank has enough blocks to share evenly, but no more
    /// than 16 times the least. What follows in memory is read faster.
    static std::size_t usual_block(std::size_t items_of_rank) {
        constexpr std::size_t enough = 64;
        return min_block * std::clamp<std::size_t>(items_of_rank / (enough * min_block), 1, 16);
    }
    void gather_bytes(std::span<std::byte> all, std::size_t bytes_each) const;
    void gather_rounds(std::span<std::byte> some, std::size_t bytes_of_block) const;

    const Ranks* ranks_;
    std::size_t count_, index_; ///< number of ranks, and which of them this is
    std::size_t all_, block_, own_;
};

template <class T>
void Ranks::give_to_all(unsigned rank, std::span<T> items) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::size_t> sizes(count());
    sizes[rank] = items.size_bytes();
    if (are_several())
        gather(sizes, std::as_writable_bytes(items));
}

template <class T>
std::vector<T> Ranks::of_each(const T& value) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count(), value);
    if (are_several())
        gather(std::vector(count(), sizeof(T)), std::as_writable_bytes(std::span(values)));
    return values;
}

template <class T>
std::vector<std::vector<T>> Ranks::exchange(const std::vector<std::vector<T>>& sent) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::uint64_t> sizes(count() * count()); // sent by each to each
    std::vector<std::span<const std::byte>> bytes;
    for (std::size_t r = 0; r < sent.size(); ++r) {
        sizes[index() * count() + r] = sent[r].size();
        bytes.push_back(std::as_bytes(std::span(sent[r])));
    }
    gather(std::vector(count(), count() * sizeof(std::uint64_t)),
           std::as_writable_bytes(std::span(sizes)));
    std::vector<std::vector<T>> received(count());
    std::vector<std::span<std::byte>> places;
    for (std::size_t r = 0; r < count(); ++r) {
        received[r].resize(sizes[r * count() + index()]);
        places.push_back(std::as_writable_bytes(std::span(received[r])));
    }
    exchange_bytes(bytes, places);
    return received;
}

} // namespace hemilux
