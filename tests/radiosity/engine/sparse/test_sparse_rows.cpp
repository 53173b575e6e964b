// Sparse matrices by rows: their mean against sums over dense ones.
#include "radiosity/engine/sparse/sparse_rows.h"

#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <algorithm>
#include <set>
#include <vector>

using namespace hemilux;

namespace {

/// Some entries here and there, symmetric, with columns that come twice in a row; the first rows
/// are empty.
SparseRows scattered(std::size_t n, std::uint64_t seed) {
    Rng rng(seed);
    const EntryWords words(n, 100);
    std::vector<std::vector<std::uint32_t>> rows(n);
    for (std::size_t k = 0; k < 8 * n; ++k) {
        const auto i = 3 + static_cast<std::uint32_t>(rng.uniform() * double(n - 3));
        const auto j = 3 + static_cast<std::uint32_t>(rng.uniform() * double(n - 3));
        const auto value = static_cast<float>(rng.uniform());
        rows[i].push_back(words.pack(i, j, value));
        rows[j].push_back(words.pack(j, i, value));
    }
    std::vector<std::uint32_t> sizes;
    for (const auto& row : rows)
        sizes.push_back(static_cast<std::uint32_t>(row.size()));
    SparseRows result(std::move(sizes), 100);
    for (std::size_t i = 0; i < n; ++i)
        std::ranges::copy(rows[i], result.to_write(i));
    return result;
}

void add(const SparseRows& rows, double factor, std::vector<double>& dense) {
    const std::size_t n = rows.rows();
    for (std::size_t i = 0; i < n; ++i)
        for (const std::uint32_t word : rows.row(i))
            dense[i * n + rows.words().column(word)] +=
                factor * static_cast<double>(rows.words().value(word));
}

} // namespace

TEST_CASE("The mean of sparse matrices is that of dense ones, symmetric, each column once") {
    for (const std::size_t n : {5u, 64u, 200u}) { // a part of a chunk, a whole one, some
        std::vector<SparseRows> parts;
        std::vector<double> expected(n * n), found(n * n);
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            parts.push_back(scattered(n, seed));
            CHECK(parts.back().entries() == 16 * n);
            add(parts.back(), .25, expected);
        }
        const SparseRows mean(std::move(parts), Workers(3));
        REQUIRE(mean.rows() == n);
        add(mean, 1, found);
        std::size_t entries = 0;
        for (std::size_t i = 0; i < n; ++i) {
            std::set<std::uint32_t> columns;
            for (const std::uint32_t word : mean.row(i))
                columns.insert(mean.words().column(word));
            CHECK(columns.size() == mean.row(i).size());
            entries += columns.size();
            for (std::size_t j = 0; j < n; ++j) {
                CHECK(found[i * n + j] == Approx(expected[i * n + j]).epsilon(1e-5));
                CHECK(found[i * n + j] == found[j * n + i]);
            }
        }
        CHECK(mean.entries() == entries);
        CHECK(mean.row(0).empty());
    }
}
