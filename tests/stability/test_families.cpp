// Reported errors against true ones, over scenes that make it easy to miss light
// (support/families). The program hemilux_reliability prints the same as a table.
//
// A run is wrong if its true error is more than 1.5 times the reported one, or if the mean of a
// part of the scene is off by more than 3 of its reported standard errors. A run that reports NaN
// or infinity is not wrong, but useless: the controls may have none.
//
// A method may be wrong in one run of 40. Then the number of wrong ones among n runs is binomial,
// and a test fails where so many or more of them have a probability below the significance, shared
// out among the scenes, the families and their total. So 8 runs of a scene with 5 wrong ones fail.
#include "support/catch.h"
#include "support/families/reliability.h"
#include "support/statistics.h"

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
        unknown += run.unknown && !run.stopped; // one that was stopped need not know
    }
    void add(const Count& other) {
        runs += other.runs;
        wrong += other.wrong;
        unknown += other.unknown;
    }
    [[nodiscard]] bool too_many_wrong(double chance) const {
        return wrong > 0 && at_least(wrong, runs, wrong_share) < chance;
    }
};

Count runs_of(const HardSceneEntry& entry, const Method& method, std::size_t seeds,
              const RunLimits& limits) {
    constexpr unsigned threads = 2;
    const PreparedScene scene(hard_scene(entry));
    Count count;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        count.add(judge_run(scene, method, stop_rule(method, {}), seed, threads, limits));
    return count;
}

/// The scenes one by one, their families, and all together; the significance is shared with the
/// other ones of so many methods.
void check_scenes(const std::string& method, const std::vector<const HardSceneEntry*>& entries,
                  std::size_t seeds, const RunLimits& limits, std::size_t of_methods = 1) {
    std::map<std::string, Count> families;
    for (const HardSceneEntry* const entry : entries)
        families[entry->family];
    const double chance = sidak(significance, of_methods * (entries.size() + families.size() + 1));
    for (const HardSceneEntry* const entry : entries) {
        const Count count = runs_of(*entry, *find_method(method), seeds, limits);
        families[entry->family].add(count);
        CAPTURE(method, entry->family, entry->name, count.runs, count.wrong, count.unknown);
        CHECK_FALSE(count.too_many_wrong(chance));
        if (entry->family == "control")
            CHECK(count.unknown == 0);
    }
    Count all;
    for (const auto& [family, count] : families) {
        all.add(count);
        CAPTURE(method, family, count.runs, count.wrong);
        CHECK_FALSE(count.too_many_wrong(chance));
    }
    CAPTURE(method, all.runs, all.wrong);
    CHECK_FALSE(all.too_many_wrong(chance));
}

/// Those of some names, or all if there are none.
std::vector<const HardSceneEntry*> scenes_named(const std::vector<std::string>& names = {}) {
    std::vector<const HardSceneEntry*> found;
    for (const HardSceneEntry& entry : hard_scenes())
        if (names.empty() || std::ranges::find(names, entry.name) != names.end())
            found.push_back(&entry);
    return found;
}

const std::vector<std::string> one_of_each_kind{
    "height 10 width 1",
    "height 100 width 1",
    "ground and panel",
    "room with roof opening",
    "0.001, reflectance 0.5",
    "over ground, 0.01, reflectance 0.8",
    "reflectance 0.8, 5 cells open",
    "reflectance 0.99, port 0.1 of a triangle's edge, one emits",
    "two rooms, 1 and 1e-06",
    "1, 1e-4, 0",
    "900 equal lamps",
    "5 rooms",
    "open scene"};

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

TEST_CASE("Stored transport reports an error in which one can trust: one scene of each kind",
          "[slow]") {
    check_scenes("stored-transport", scenes_named(one_of_each_kind), 3,
                 {.seconds = 60, .rays = 1'000'000});
}

TEST_CASE("Every other method reports an error in which one can trust", "[slow]") {
    // Each takes one scene of sixteen, other ones than the next method.
    constexpr std::size_t share = 16;
    std::size_t turn = 0;
    for (const Method* const method : methods()) {
        if (method->name == "stored-transport")
            continue;
        std::vector<const HardSceneEntry*> entries;
        for (std::size_t k = turn++ % share; k < hard_scenes().size(); k += share)
            entries.push_back(&hard_scenes()[k]);
        check_scenes(std::string(method->name), entries, 2, {.seconds = 60, .rays = 300'000},
                     methods().size() - 1);
    }
}

TEST_CASE("Stored transport reports an error in which one can trust: all scenes", "[slow]") {
    check_scenes("stored-transport", scenes_named(), 4, {.seconds = 60, .rays = 4'000'000});
}

TEST_CASE("Rooms that no ray of theirs has seen the light from are in doubt for matrix too",
          "[slow]") {
    check_scenes("matrix", scenes_named({"30 rooms"}), 4, {.seconds = 60, .rays = 10'000'000});
}
