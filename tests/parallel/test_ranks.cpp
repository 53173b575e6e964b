// Ranks that are threads: what each gets of the others.
#include "parallel/gathered_vector.h"
#include "support/catch.h"
#include "support/rank_threads.h"

#include <atomic>
#include <cstdint>
#include <numeric>
#include <stdexcept>

using namespace hemilux;

namespace {

/// Whether it holds on each of so many ranks. Catch2 takes assertions of one thread alone.
template <class Holds>
bool on_all(unsigned count, const Holds& holds, RankMemory memory = RankMemory::own) {
    std::atomic<unsigned> right{0};
    run_as_ranks(
        count, [&](const Ranks& ranks) { right += holds(ranks) ? 1 : 0; }, memory);
    return right == count;
}

} // namespace

TEST_CASE("Each item has one owner, and blocks of them follow each other in turn") {
    for (const unsigned count : {1u, 2u, 3u, 5u})
        for (const std::size_t items : {0u, 1u, 4u, 5u, 23u, 24u, 61u})
            CHECK(on_all(count, [&](const Ranks& ranks) {
                const OwnBlocks own(ranks, items, 4);
                std::vector<std::uint32_t> owned(items);
                bool right = true;
                for (std::size_t k = 0; k < own.count() && right; ++k) {
                    const std::size_t item = own.item(k);
                    right = item < items && own.owns(item) && own.owner(item) == ranks.index();
                    owned.at(item) = 1;
                }
                return ranks.sum(own.count()) == items && right &&
                       std::accumulate(owned.begin(), owned.end(), 0u) == own.count();
            }));
}

TEST_CASE("All ranks have what the owners wrote, and count the bytes") {
    struct Item {
        std::uint64_t number;
        double value;
    };
    for (const unsigned count : {1u, 2u, 3u, 5u})
        for (const std::size_t items : {0u, 1u, 63u, 64u, 65u, 1000u, 1'500'000u})
            CHECK(on_all(count, [&](const Ranks& ranks) {
                const OwnBlocks own(ranks, items);
                std::vector<Item> all(items, {~std::uint64_t{0}, -1});
                for (std::size_t k = 0; k < own.count(); ++k)
                    all[own.item(k)] = {own.item(k), .5 * static_cast<double>(own.item(k))};
                own.gather(all);
                bool right = true;
                for (std::size_t i = 0; i < items; ++i)
                    right &= all[i].number == i && all[i].value == .5 * static_cast<double>(i);
                const RankWork work = ranks.work();
                return right && work.received == (items - own.count()) * sizeof(Item) &&
                       work.sent == own.count() * sizeof(Item) * (count - 1);
            }));
}

TEST_CASE("Values of an item are gathered together") {
    CHECK(on_all(3, [](const Ranks& ranks) {
        const OwnBlocks own(ranks, 23, 4);
        std::vector<std::size_t> all(2 * own.items());
        for (std::size_t k = 0; k < own.count(); ++k)
            for (const std::size_t v : {0u, 1u})
                all[2 * own.item(k) + v] = 2 * own.item(k) + v;
        own.gather(all, 2);
        std::vector<std::size_t> expected(all.size());
        std::iota(expected.begin(), expected.end(), std::size_t{0});
        return all == expected;
    }));
}

TEST_CASE("A gathered vector has what the owners wrote, and sends nothing where it is shared") {
    for (const RankMemory memory : {RankMemory::own, RankMemory::shared})
        for (const unsigned count : {1u, 2u, 5u})
            CHECK(on_all(
                count,
                [&](const Ranks& ranks) {
                    const OwnBlocks own(ranks, 1000);
                    GatheredVector<double> all(own), others(own);
                    bool right = true;
                    for (const double factor : {1.0, 2.0, 3.0}) {
                        for (std::size_t k = 0; k < own.count(); ++k)
                            all[own.item(k)] = factor * static_cast<double>(own.item(k));
                        all.gather();
                        for (std::size_t i = 0; i < own.items(); ++i)
                            right &= all[i] == factor * static_cast<double>(i);
                        others.gather(); // all have read
                    }
                    return right &&
                           (ranks.work().sent > 0) == (count > 1 && memory == RankMemory::own);
                },
                memory));
}

TEST_CASE("Ranks agree on a flag, and the first one's clock holds for all") {
    CHECK(on_all(4, [](const Ranks& ranks) {
        std::vector<unsigned> of_one(3, ranks.index());
        ranks.give_to_all(2, std::span(of_one));
        return ranks.any(ranks.index() == 2) && !ranks.any(false) &&
               !ranks.all(ranks.index() != 3) && ranks.all(true) &&
               ranks.of_first(10 + ranks.index()) == 10 && ranks.sum(ranks.index()) == 6 &&
               of_one == std::vector(3, 2u);
    }));
}

TEST_CASE("What is sent arrives at its rank, in order") {
    CHECK(on_all(3, [](const Ranks& ranks) {
        const auto letter = [](std::size_t from, std::size_t to, std::size_t k) {
            return static_cast<std::uint32_t>(100 * from + 10 * to + k);
        };
        std::vector<std::vector<std::uint32_t>> sent(3);
        for (std::size_t to = 0; to < 3; ++to)
            for (std::size_t k = 0; k < ranks.index() + to; ++k)
                sent[to].push_back(letter(ranks.index(), to, k));
        const auto received = ranks.exchange(sent);
        bool right = true;
        for (std::size_t from = 0; from < 3; ++from) {
            right &= received[from].size() == from + ranks.index();
            for (std::size_t k = 0; k < received[from].size(); ++k)
                right &= received[from][k] == letter(from, ranks.index(), k);
        }
        return right;
    }));
}

TEST_CASE("Where one rank fails the others do not wait for it") {
    const auto fails = [](const Ranks& ranks) {
        if (ranks.index() == 1)
            throw std::runtime_error("no memory");
        (void)ranks.any(false);
    };
    CHECK_THROWS_WITH(run_as_ranks(3, fails), "no memory");
}
