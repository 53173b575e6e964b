// Reported errors against true ones, over scenes that make it easy to miss light
// (support/families). The program hemilux_reliability prints the same as a table.
//
// A run is wrong if its true error is more than 1.5 times the reported one, or if the mean of a
// part of the scene is off by more than 3 of its reported standard errors; a run that reports NaN
// or infinity is not wrong, but useless: the controls may have none. A method may be wrong in one
// run of 40. With this probability the number of wrong ones among n runs is binomial, and a test
// fails where so many or more have a probability below the significance, shared out among the tests
// of a case: of 4 runs of a scene 3 wrong ones are too many, of 40 runs of a family 8.
#include "support/families/reliability.h"
#include "support/statistics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

constexpr double wrong_share = 1.0 / 40;

/// Probability of at least k of n, each with the probability p.
double at_least(std::size_t k, std::size_t n, double p) {
    double less = 0, term = std::pow(1 - p, double(n));
    for (std::size_t i = 0; i < k; ++i) {
        less += term;
        term *= double(n - i) / double(i + 1) * p / (1 - p);
    }
    return 1 - less;
}

struct Count {
    std::size_t runs = 0, wrong = 0, unknown = 0;
    void add(const JudgedRun& run) {
        ++runs;
        wrong += run.wrong || run.part_wrong;
        unknown += run.unknown;
    }
    [[nodiscard]] bool too_many_wrong(double chance) const {
        return wrong > 0 && at_least(wrong, runs, wrong_share) < chance;
    }
};

Count runs_of(const HardSceneEntry& entry, const Method& method, std::size_t seeds,
              const RunLimits& limits, Count& family) {
    const PreparedScene scene(hard_scene(entry));
    Count count;
    for (std::size_t k = 0; k < seeds; ++k) {
        const JudgedRun run = judge_run(scene, method, stop_rule(method, {}), 1 + k, 2, limits);
        count.add(run);
        family.add(run);
    }
    return count;
}

/// All scenes for which `wanted` holds.
template <class Wanted>
void check_scenes(const char* method, std::size_t seeds, const RunLimits& limits,
                  const Wanted& wanted) {
    std::vector<const HardSceneEntry*> entries;
    for (const HardSceneEntry& entry : hard_scenes())
        if (wanted(entry))
            entries.push_back(&entry);
    std::map<std::string, Count> families;
    for (const HardSceneEntry* const entry : entries)
        families[entry->family];
    const double chance = sidak(significance, entries.size() + families.size());
    for (const HardSceneEntry* const entry : entries) {
        const Count count =
            runs_of(*entry, *find_method(method), seeds, limits, families[entry->family]);
        CAPTURE(method, entry->family, entry->name, count.runs, count.wrong, count.unknown);
        CHECK_FALSE(count.too_many_wrong(chance));
        if (entry->family == "control")
            CHECK(count.unknown == 0);
    }
    for (const auto& [family, count] : families) {
        CAPTURE(method, family, count.runs, count.wrong);
        CHECK_FALSE(count.too_many_wrong(chance));
    }
}

} // namespace

TEST_CASE("Wrong runs are counted by the binomial distribution") {
    CHECK(at_least(0, 40, wrong_share) == Approx(1));
    CHECK(at_least(1, 40, wrong_share) == Approx(1 - std::pow(39.0 / 40, 40)));
    CHECK(at_least(4, 4, wrong_share) == Approx(std::pow(wrong_share, 4)).epsilon(1e-6));
    Count count;
    count.runs = 4;
    count.wrong = 2;
    CHECK_FALSE(count.too_many_wrong(1e-3));
    count.wrong = 3;
    CHECK(count.too_many_wrong(1e-3));
}

TEST_CASE("Gathering reports an error in which one can trust: one scene of each kind") {
    const std::vector<std::string> names{
        "height 10 width 1",
        "height 100 width 1",
        "ground and panel",
        "room with roof opening",
        "0.001, reflectance 0.5",
        "0.01, reflectance 0.5",
        "reflectance 0.8, 5 cells open",
        "reflectance 0.99, port 0.1 of a triangle's edge, one emits",
        "two rooms, 1 and 1e-06",
        "1, 1e-4, 0",
        "900 equal lamps",
        "5 rooms",
        "open scene"};
    check_scenes("gathering", 3, {.seconds = 2, .rays = 1'000'000},
                 [&](const HardSceneEntry& entry) {
                     return std::ranges::find(names, entry.name) != names.end();
                 });
}

TEST_CASE("Gathering reports an error in which one can trust: all scenes", "[slow]") {
    check_scenes("gathering", 8, {.seconds = 20, .rays = 10'000'000},
                 [](const HardSceneEntry&) { return true; });
}
