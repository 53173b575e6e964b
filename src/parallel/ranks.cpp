#include "parallel/ranks.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace hemilux {
namespace {

class OneRank final : public Ranks {
  public:
    [[nodiscard]] unsigned count() const override { return 1; }
    [[nodiscard]] unsigned index() const override { return 0; }
    void wait_for_all() const override {}

  private:
    void do_gather(std::span<const std::size_t> /*sizes*/,
                   std::span<std::byte> /*all*/) const override {}
    void do_exchange(std::span<const std::span<const std::byte>> sent,
                     std::span<const std::span<std::byte>> received) const override {
        std::ranges::copy(sent[0], received[0].begin());
    }
};

/// The bytes that are gathered at a time: they are kept twice meanwhile, in a processor's cache.
constexpr std::size_t bytes_at_a_time = std::size_t{1} << 20;

} // namespace

const Ranks& one_rank() {
    static const OneRank one;
    return one;
}

void Ranks::gather(std::span<const std::size_t> sizes, std::span<std::byte> all) const {
    do_gather(sizes, all);
    const std::size_t own = sizes[index()];
    sent_ += own * (count() - 1);
    received_ += all.size() - own;
}

void Ranks::exchange_bytes(std::span<const Bytes> sent,
                           std::span<const std::span<std::byte>> received) const {
    do_exchange(sent, received);
    for (std::size_t r = 0; r < count(); ++r)
        if (r != index()) {
            sent_ += sent[r].size();
            received_ += received[r].size();
        }
}

bool Ranks::any(bool value) const {
    const std::vector<char> values = of_each(static_cast<char>(value));
    return std::ranges::any_of(values, [](char each) { return each != 0; });
}

std::uint64_t Ranks::sum(std::uint64_t value) const {
    const std::vector<std::uint64_t> values = of_each(value);
    return std::accumulate(values.begin(), values.end(), std::uint64_t{0});
}

std::size_t OwnBlocks::items_of(std::size_t rank) const {
    const std::size_t round = block_ * count_, rest = all_ % round;
    const std::size_t before = std::min(rest, rank * block_);
    return all_ / round * block_ + std::min(rest - before, block_);
}

void OwnBlocks::gather_bytes(std::span<std::byte> all, std::size_t bytes_each) const {
    const std::size_t block = block_ * bytes_each, round = block * count_;
    const std::size_t piece = round * std::max<std::size_t>(1, bytes_at_a_time / round);
    for (std::size_t begin = 0; begin < all.size(); begin += piece)
        gather_rounds(all.subspan(begin, std::min(piece, all.size() - begin)), block);
}

/// Gathers whole rounds of blocks; the last round may be shorter.
void OwnBlocks::gather_rounds(std::span<std::byte> some, std::size_t bytes_of_block) const {
    const std::size_t round = bytes_of_block * count_;
    std::vector<std::size_t> sizes;
    for (std::size_t r = 0; r < count_; ++r)
        sizes.push_back(OwnBlocks(*ranks_, some.size(), bytes_of_block).items_of(r));
    const auto packed = std::make_unique_for_overwrite<std::byte[]>(some.size());
    std::vector<std::size_t> places(count_);
    std::exclusive_scan(sizes.begin(), sizes.end(), places.begin(), std::size_t{0});
    const auto for_blocks_of = [&](std::size_t r, const auto& copy) {
        std::byte* next = &packed[places[r]];
        for (std::size_t at = r * bytes_of_block; at < some.size(); at += round) {
            const std::size_t size = std::min(bytes_of_block, some.size() - at);
            copy(&some[at], next, size);
            next += size;
        }
    };
    for_blocks_of(index_, [](const std::byte* items, std::byte* to, std::size_t size) {
        std::memcpy(to, items, size);
    });
    ranks_->gather(sizes, {packed.get(), some.size()});
    for (std::size_t r = 0; r < count_; ++r)
        if (r != index_)
            for_blocks_of(r, [](std::byte* items, const std::byte* from, std::size_t size) {
                std::memcpy(items, from, size);
            });
}

} // namespace hemilux
