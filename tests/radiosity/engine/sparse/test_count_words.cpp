// Words of counts: what is packed comes out again.
#include "radiosity/engine/sparse/count_words.h"

#include "support/catch.h"

#include <cstdint>

using namespace hemilux;

TEST_CASE("Words hold columns and counts up to the largest of both") {
    for (const std::size_t columns : {1ull, 2ull, 3ull, 1005ull, 1ull << 20, 1ull << 31}) {
        const CountWords words(columns);
        const auto last = static_cast<std::uint32_t>(columns - 1);
        for (const std::uint32_t column : {0u, last / 2, last})
            for (const std::uint32_t count : {1u, words.max_count()}) {
                const std::uint32_t word = words.pack(column, count);
                CHECK(words.column(word) == column);
                CHECK(words.count(word) == count);
                CHECK(words.is_full(word) == (count == words.max_count()));
            }
    }
}
