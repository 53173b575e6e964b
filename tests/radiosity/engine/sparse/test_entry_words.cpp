// Words of entries: columns come out again, and values but for an unbiased rounding.
#include "radiosity/engine/sparse/entry_words.h"

#include "support/catch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

using namespace hemilux;

TEST_CASE("Words hold columns, and values from the largest to 2^-124 of it, nearly as they are") {
    for (const std::size_t columns : {1ull, 9ull, 1005ull, 1ull << 20, 1ull << 25})
        for (const float largest : {.7f, 1.0f, 6.0f, 1e20f}) {
            const EntryWords words(columns, largest);
            const auto last = static_cast<std::uint32_t>(columns - 1);
            const int bits = 25 - std::max(int(std::bit_width(last)), 2); // of the fraction
            for (const std::uint32_t column : {0u, last / 2, last})
                for (float value = largest; value > std::max(0x1p-124f * largest, 0x1p-126f);
                     value *= .37f) {
                    const std::uint32_t word = words.pack(last / 3, column, value);
                    CHECK(words.column(word) == column);
                    CHECK(std::abs(words.value(word) - value) <= std::ldexp(value, -bits));
                }
        }
}

TEST_CASE("What is too small for a word is the least, and what is too large the largest") {
    const EntryWords words(1 << 20, 1);
    CHECK(words.value(words.pack(1, 2, 0)) > 0);
    CHECK(words.value(words.pack(1, 2, 0)) < 0x1p-124f);
    CHECK(words.value(words.pack(1, 2, 1e30f)) >= 1);
    CHECK(words.column(words.pack(1, 2, 1e30f)) == 2);
}

TEST_CASE("Rounded values are right in the mean, and the same in row and column") {
    for (const std::size_t columns : {1ull << 10, 1ull << 20, 1ull << 24}) {
        const EntryWords words(columns, 1);
        for (const float value : {1.0f, .999f, .3f, .2501f, .24f, 1e-6f}) {
            double sum = 0, squares = 0;
            int count = 0;
            for (std::uint32_t i = 0; i < 200; ++i)
                for (std::uint32_t j = 0; j < i; ++j, ++count) {
                    const float found = words.value(words.pack(i, j, value));
                    CHECK(found == words.value(words.pack(j, i, value)));
                    const double off = double(found) / double(value) - 1;
                    sum += off;
                    squares += off * off;
                }
            const double mean = sum / count, deviation = std::sqrt(squares / count);
            CHECK(std::abs(mean) <= 4 * deviation / std::sqrt(count) + 1e-9);
        }
    }
}

TEST_CASE("More columns than leave room for a value are refused") {
    CHECK_THROWS_AS(EntryWords((std::size_t{1} << 25) + 1, 1), std::length_error);
}
