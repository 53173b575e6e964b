// Loops over threads: each index once, in order where order is promised, and errors come through.
#include "geometry/workers.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <numeric>
#include <stdexcept>
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
