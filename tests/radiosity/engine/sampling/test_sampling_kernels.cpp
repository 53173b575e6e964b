// Every instruction set draws the same samples to the last bit, and they are what they should be.

#include "geometry/vector.h"
#include "parallel/instruction_set.h"
#include "radiosity/engine/sampling/sampling_kernels.h"
#include "radiosity/engine/sampling/sobol.h"
#include "radiosity/engine/sparse/entry_words.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/sobol.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace hemilux;
using test::sobol4;

namespace {

/// Numbers in [0,1], the ends and the middle among them.
std::vector<double> some_numbers(std::size_t count, std::uint64_t seed) {
    Rng rng(seed);
    std::vector<double> numbers(count);
    for (double& x : numbers)
        x = rng.uniform();
    numbers[0] = numbers[1] = .5;
    numbers[2] = 0;
    numbers[3] = 1;
    return numbers;
}

struct Directions {
    std::vector<double> x, y, z;
};
Directions directions(const SamplingKernels& kernels, const std::vector<double>& u,
                      const std::vector<double>& v) {
    Directions d{u, u, u};
    kernels.cosine(u.size(), u.data(), v.data(), d.x.data(), d.y.data(), d.z.data());
    return d;
}

} // namespace

TEST_CASE("every instruction set gives the same directions") {
    const auto u = some_numbers(1003, 1), v = some_numbers(1003, 2);
    const Directions expected = directions(sampling_kernels(InstructionSet::baseline), u, v);
    for (const InstructionSet set : available_instruction_sets()) {
        const Directions d = directions(sampling_kernels(set), u, v);
        CHECK(d.x == expected.x);
        CHECK(d.y == expected.y);
        CHECK(d.z == expected.z);
    }
}

TEST_CASE("directions are those of the concentric map, to the last bits") {
    const auto u = some_numbers(100'000, 3), v = some_numbers(100'000, 4);
    const Directions d = directions(sampling_kernels(), u, v);
    double worst = 0, longest = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
        const double a = 2 * u[k] - 1, b = 2 * v[k] - 1, eighth = std::numbers::pi / 4;
        const bool wide = std::abs(a) > std::abs(b);
        const double r = wide ? a : b;
        const double phi = r == 0 ? 0 : wide ? eighth * (b / a) : 2 * eighth - eighth * (a / b);
        worst = std::max(
            {worst, std::abs(d.x[k] - r * std::cos(phi)), std::abs(d.y[k] - r * std::sin(phi))});
        longest = std::max(longest, std::abs(glm::length(Vec3(d.x[k], d.y[k], d.z[k])) - 1));
    }
    CHECK(worst < 5e-16); // half of it is the rounding of phi here
    CHECK(longest < 4e-16);
}

TEST_CASE("every instruction set gives the same points") {
    Rng rng(5);
    SobolBlockStart start{};
    SobolSteps steps{};
    for (std::size_t d = 0; d < max_dimensions; ++d) {
        start.seeds[d] = static_cast<std::uint32_t>(rng.bits());
        start.first[d] = static_cast<std::uint32_t>(rng.bits());
        for (std::uint32_t& step : steps.step[d])
            step = static_cast<std::uint32_t>(rng.bits());
    }
    using Points = std::array<double, samples_per_block * max_dimensions>;
    Points expected{};
    sampling_kernels(InstructionSet::baseline).sobol(start, steps, max_dimensions, expected.data());
    for (const InstructionSet set : available_instruction_sets()) {
        Points points{};
        sampling_kernels(set).sobol(start, steps, max_dimensions, points.data());
        CHECK(points == expected);
    }
}

TEST_CASE("a block holds the points of its sequence") {
    SobolBlocks<5> blocks(77);
    for (const std::uint32_t index : {0u, 15u, 16u, 1000u, 0xffffffffu}) {
        blocks.move_to(index);
        const auto expected = sobol4(index, 77);
        for (std::size_t d = 0; d < 4; ++d)
            CHECK(blocks.point(index)[d] == expected[d]);
    }
}

TEST_CASE("every instruction set finds the same places") {
    std::vector<double> sums{0};
    Rng rng(6);
    for (int k = 0; k < 50; ++k) // some of no width
        sums.push_back(sums.back() + std::max(rng.uniform() - .3, 0.0));
    const double end = std::nextafter(sums.back(), 0.0);
    sums.resize(64, std::numeric_limits<double>::infinity());
    std::vector<double> at = some_numbers(1003, 7);
    for (double& each : at)
        each = std::min(each * sums[50], end);
    for (const InstructionSet set : available_instruction_sets()) {
        std::vector<std::uint64_t> places(at.size());
        sampling_kernels(set).find_places(sums.data(), sums.size(), at.size(), at.data(),
                                          places.data());
        for (std::size_t k = 0; k < at.size(); ++k) {
            CHECK(sums[places[k]] <= at[k]);
            CHECK(at[k] < sums[places[k] + 1]);
        }
    }
}

TEST_CASE("every instruction set counts the same rays into the cells of a patch") {
    Rng rng(7);
    for (std::size_t cells = 1; cells <= 64; ++cells) {
        std::vector<double> up_to; // some of no width, at the end too
        for (std::size_t k = 0; k < cells; ++k)
            up_to.push_back((k > 0 ? up_to[k - 1] : .01) + std::max(rng.uniform() - .4, 0.0));
        const double before = 1e6 * rng.uniform(), rays = 100 * rng.uniform() / double(cells);
        const PatchOnLine line{before, before + rays * up_to.back(), rays, up_to.back()};
        for (const InstructionSet set : available_instruction_sets()) {
            std::vector<std::int64_t> last(cells + 1, -1);
            last[0] = static_cast<std::int64_t>(before);
            const std::uint64_t with_rays =
                sampling_kernels(set).last_rays(line, cells, up_to.data(), last.data());
            for (std::size_t k = 0; k < cells; ++k) {
                const double end = up_to[k] < line.all ? before + rays * up_to[k] : line.after;
                CHECK(last[k + 1] == static_cast<std::int64_t>(std::floor(end)));
                CHECK((with_rays >> k & 1) == (last[k + 1] > last[k] ? 1 : 0));
            }
            CHECK((cells == 64 || with_rays >> cells == 0));
        }
    }
}

TEST_CASE("every instruction set gives the same random numbers and directions into cells") {
    constexpr std::size_t n = 1003;
    Rng rng(8);
    std::vector<std::uint32_t> low(n), high(n), number(n);
    std::vector<std::int32_t> cell(n);
    for (std::size_t k = 0; k < n; ++k) {
        low[k] = static_cast<std::uint32_t>(rng.bits());
        high[k] = static_cast<std::uint32_t>(rng.bits());
        number[k] = static_cast<std::uint32_t>(k);
        cell[k] = static_cast<std::int32_t>(k % 10);
    }
    CellShapes shapes{};
    std::vector<std::vector<double>> parts;
    for (unsigned i = 0; i < CellShapes::parts; ++i) {
        std::vector<double>& part = parts.emplace_back();
        for (int c = 0; c < 10; ++c)
            part.push_back(i == CellShapes::half ? c % 2 : rng.uniform() - .3);
        shapes.part[i] = part.data();
    }
    using Numbers = std::vector<double>;
    const auto draw = [&](InstructionSet set) {
        std::array<Numbers, 7> r;
        r.fill(Numbers(n));
        std::vector<std::uint32_t> inside(n);
        const SamplingKernels& kernels = sampling_kernels(set);
        kernels.random({low.data(), high.data(), number.data()}, n, 3, r[0].data(), r[1].data(),
                       r[2].data(), r[3].data());
        kernels.in_cells(shapes, n, cell.data(), r[0].data(), r[1].data(), r[4].data(), r[5].data(),
                         r[6].data(), inside.data());
        return std::pair(r, inside);
    };
    const auto expected = draw(InstructionSet::baseline);
    CHECK(std::ranges::count(expected.second, 1u) > 10);
    CHECK(std::ranges::count(expected.second, 0u) > 10);
    for (const InstructionSet set : available_instruction_sets())
        CHECK(draw(set) == expected);
}

TEST_CASE("every instruction set gives the same products with a row") {
    Rng rng(7);
    std::vector<Lanes> x(50);
    for (Lanes& lanes : x)
        for (int c = 0; c < 3; ++c)
            lanes.lane[c] = rng.uniform();
    const EntryWords words(x.size(), 1);
    std::vector<std::uint32_t> row;
    for (std::size_t count = 0; count < 20; ++count) {
        Vec3 plain(0.0);
        for (const std::uint32_t word : row)
            for (int c = 0; c < 3; ++c)
                plain[c] += words.value(word) * x[words.column(word)].lane[c];
        Lanes expected{};
        sampling_kernels(InstructionSet::baseline)
            .row_times(row.data(), count, words.format(), x.data(), &expected);
        for (const InstructionSet set : available_instruction_sets()) {
            Lanes sum{};
            sampling_kernels(set).row_times(row.data(), count, words.format(), x.data(), &sum);
            for (int c = 0; c < 3; ++c) {
                CHECK(sum.lane[c] == expected.lane[c]);
                CHECK(sum.lane[c] == Approx(plain[c]).epsilon(1e-14));
            }
        }
        row.push_back(words.pack(0, std::uint32_t(50 * rng.uniform()), float(rng.uniform())));
    }
}

TEST_CASE("every instruction set weighs emitters and clusters alike") {
    constexpr std::size_t n = 203;
    Rng rng(9);
    std::vector<std::vector<double>> numbers;
    const auto more = [&](double least) {
        std::vector<double>& some = numbers.emplace_back(n);
        for (double& x : some)
            x = least + rng.uniform();
        return some.data();
    };
    EmitterArrays emitters{};
    EmitterReceiver to{};
    for (int axis = 0; axis < 3; ++axis) {
        emitters.centre[axis] = more(-.5);
        emitters.normal[axis] = more(-.5);
        to.centre[axis] = rng.uniform() - .5;
        to.normal[axis] = rng.uniform() - .5;
        for (std::size_t i = 0; i < 4; ++i) {
            emitters.corner[i][axis] = more(-.5);
            to.corner[i][axis] = rng.uniform() - .5;
        }
    }
    emitters.area = more(0);
    emitters.side = more(0);
    emitters.light = more(0);
    to.side = to.radius = .1;
    const ClusterArrays clusters{
        {more(-.5), more(-.5), more(-.5)}, more(0), more(0), more(0), more(0)};
    const auto weights = [&](InstructionSet set) {
        std::array<std::vector<double>, 4> result;
        result.fill(std::vector<double>(n));
        sampling_kernels(set).weigh_emitters(emitters, n, to, result[0].data(), result[1].data());
        sampling_kernels(set).weigh_clusters(clusters, n, to, result[2].data(), result[3].data());
        return result;
    };
    const auto expected = weights(InstructionSet::baseline);
    for (const auto& each : expected) {
        CHECK(std::ranges::count_if(each, [](double w) { return w > 0; }) > 20);
        CHECK(std::ranges::count_if(each, [](double w) { return w == 0; }) > 0);
    }
    for (const InstructionSet set : available_instruction_sets())
        CHECK(weights(set) == expected);
}
