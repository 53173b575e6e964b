// Loops over threads: each index once, in order where order is promised, and errors come through;
// within one another, from several threads, and again and again.
#include "parallel/workers.h"
#include "support/catch.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using hemilux::Workers;

TEST_CASE("Every chunk is done once, by any number of threads") {
    for (const unsigned threads : {1u, 2u, 5u})
        for (const std::size_t count : {0u, 1u, 7u, 64u, 1000u}) {
            std::vector<std::atomic<int>> done(count);
            Workers(threads).for_chunks(count, 7, [&](std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k)
                    ++done[k];
            });
            for (const auto& times : done)
                CHECK(times == 1);
        }
}

TEST_CASE("What bodies have made is taken in order, each once, never two at a time") {
    for (const unsigned threads : {1u, 2u, 5u}) {
        constexpr std::size_t count = 2000;
        std::vector<int> made(count, 0);
        std::vector<std::size_t> taken;
        std::atomic<int> inside{0};
        bool alone = true;
        Workers(threads).for_each_in_order(
            count, [&](std::size_t k) { made[k] = static_cast<int>(k) + 1; },
            [&](std::size_t k) {
                alone = alone && ++inside == 1;
                if (made[k] == static_cast<int>(k) + 1)
                    taken.push_back(k);
                --inside;
            });
        std::vector<std::size_t> all(count);
        std::iota(all.begin(), all.end(), std::size_t{0});
        CHECK(taken == all);
        CHECK(alone);
    }
}

TEST_CASE("The first error of a body or a taker comes through") {
    const auto nothing = [](std::size_t) {};
    const auto fail = [](std::size_t k) {
        if (k == 30)
            throw std::runtime_error("thirty");
    };
    for (const unsigned threads : {1u, 3u}) {
        CHECK_THROWS_WITH(Workers(threads).for_each_in_order(100, fail, nothing), "thirty");
        CHECK_THROWS_WITH(Workers(threads).for_each_in_order(100, nothing, fail), "thirty");
    }
}

namespace {

/// The sum of 0 ... count - 1, by a loop within each turn of a loop.
std::size_t nested_sum(unsigned threads, std::size_t count) {
    std::atomic<std::size_t> sum{0};
    Workers(threads).for_chunks(count, 10, [&](std::size_t begin, std::size_t end) {
        Workers(threads).for_chunks(end - begin, 1,
                                    [&](std::size_t k, std::size_t) { sum += begin + k; });
    });
    return sum;
}

} // namespace

TEST_CASE("Loops within loops, from several threads at once, all end") {
    constexpr std::size_t count = 1000;
    std::vector<std::size_t> sums(6, 0);
    {
        std::vector<std::jthread> callers;
        for (std::size_t c = 0; c < sums.size(); ++c)
            callers.emplace_back([&, c] {
                for (int turn = 0; turn < 20; ++turn)
                    sums[c] += nested_sum(static_cast<unsigned>(c % 4 + 1), count);
            });
    }
    for (const std::size_t sum : sums)
        CHECK(sum == 20 * count * (count - 1) / 2);
}

TEST_CASE("Many short loops, with and without pauses between them") {
    std::size_t done = 0;
    for (int turn = 0; turn < 2000; ++turn) {
        std::atomic<std::size_t> here{0};
        Workers(3).for_chunks(4, 1, [&](std::size_t, std::size_t) { ++here; });
        done += here;
        if (turn % 200 == 0) // long enough for helpers to fall asleep
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    CHECK(done == 8000);
}

TEST_CASE("One thread is the caller's own, several are at most as many as asked for") {
    for (const unsigned threads : {1u, 3u}) {
        std::mutex mutex;
        std::set<std::thread::id> seen;
        Workers(threads).for_chunks(500, 1, [&](std::size_t, std::size_t) {
            const std::lock_guard lock(mutex);
            seen.insert(std::this_thread::get_id());
        });
        CHECK(seen.size() <= threads);
        if (threads == 1)
            CHECK(*seen.begin() == std::this_thread::get_id());
    }
}

TEST_CASE("A helper comes while the caller is at work") {
    std::atomic<int> inside{0};
    Workers(2).for_chunks(2, 1, [&](std::size_t, std::size_t) {
        ++inside;
        while (inside < 2) // each waits for the other
            std::this_thread::yield();
    });
    CHECK(inside == 2);
}

TEST_CASE("A loop that has failed does not harm the next") {
    for (int turn = 0; turn < 50; ++turn) {
        CHECK_THROWS_AS(Workers(2).for_chunks(10, 1,
                                              [](std::size_t k, std::size_t) {
                                                  if (k == 5)
                                                      throw std::runtime_error("five");
                                              }),
                        std::runtime_error);
        std::atomic<int> done{0};
        Workers(2).for_chunks(10, 1, [&](std::size_t, std::size_t) { ++done; });
        CHECK(done == 10);
    }
}
