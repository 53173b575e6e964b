// Rays of a patch and its cells: however many there are, each ray goes to the cell on whose part of
// the line it stands.

#include "radiosity/engine/shooting/systematic_cells.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"

#include <numeric>
#include <vector>

using namespace hemilux;

namespace {

/// So many cells, some without rays, the last too if that is asked for.
AllocatedCells some_cells(std::size_t count, bool empty_end, Rng& rng) {
    std::vector<double> shares(count);
    for (double& share : shares)
        share = rng.uniform() < .3 ? 0 : rng.uniform();
    shares[count / 2] = 1;
    shares.back() = empty_end ? 0 : .01;
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    AllocatedCells allocated;
    for (std::size_t k = 0; k < count; ++k)
        allocated.add(static_cast<std::uint16_t>(100 + k), shares[k] / sum);
    return allocated;
}

} // namespace

TEST_CASE("each ray goes to the cell that owns its place, for few rays and for many") {
    Rng rng(3);
    for (int trial = 0; trial < 4000; ++trial) {
        const std::size_t cells = 1 + rng.bits() % 70;
        const AllocatedCells allocated = some_cells(cells, cells > 2 && trial % 3 == 0, rng);
        const Allocation allocation = allocated.view();
        const double before = 1000 * rng.uniform();
        const double after = before + (trial % 2 == 0 ? 60 : 5) * rng.uniform();
        const double rays = (after - before) / allocation.rays_up_to.back();
        auto next = static_cast<std::int64_t>(before);
        int last = -1;
        SystematicCells(allocation, before, after)
            .for_each_cell([&](std::uint16_t cell, double expected, std::int64_t low,
                               std::int64_t high) {
                const std::size_t k = cell - 100u;
                REQUIRE(static_cast<int>(k) > last);
                last = static_cast<int>(k);
                REQUIRE(low == next);
                REQUIRE(high > low);
                REQUIRE(expected == Approx(rays * allocation.rays(k)));
                REQUIRE(expected > 0);
                REQUIRE(double(high - low) < expected + 1 + 1e-9);
                const double begin = k > 0 ? before + rays * allocation.rays_up_to[k - 1] : before;
                REQUIRE(double(low + 1) > begin - 1e-9);
                REQUIRE(double(high) <= before + rays * allocation.rays_up_to[k] + 1e-9);
                next = high;
            });
        REQUIRE(next == static_cast<std::int64_t>(after));
    }
}

TEST_CASE("each cell gets what it is due on average") {
    Rng rng(4);
    const AllocatedCells allocated = some_cells(40, true, rng);
    const Allocation allocation = allocated.view();
    for (const double expected_rays : {.3, 7.7, 51.3}) {
        std::vector<double> got(40);
        constexpr int origins =
            20'000; // evenly spread: then each mean is off by 2 / origins at most
        for (int k = 0; k < origins; ++k) {
            const double before = 5 + (k + .5) / origins;
            SystematicCells(allocation, before, before + expected_rays)
                .for_each_cell(
                    [&](std::uint16_t cell, double, std::int64_t low, std::int64_t high) {
                        got[cell - 100u] += double(high - low) / origins;
                    });
        }
        const double rays = expected_rays / allocation.rays_up_to.back();
        for (std::size_t k = 0; k < got.size(); ++k)
            CHECK(got[k] == Approx(rays * allocation.rays(k)).margin(2.5 / origins));
    }
}
