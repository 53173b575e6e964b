// What is left to chance: streams of random numbers that have nothing in common, the turn of the
// hemispheres, and the roulettes of pairs and of whole rays.
#include "geometry/frame.h"
#include "radiosity/engine/densities/cell_directions.h"
#include "radiosity/engine/progressive/shot_factors.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/statistics.h"
#include "support/step_rays.h"

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

using namespace hemilux;
using namespace hemilux::test;

namespace {

/// 7 x 11 parts of the unit square.
const std::vector<double> parts(77, 1.0 / 77);
std::size_t part_of(double u, double v) {
    return 11 * static_cast<std::size_t>(7 * u) + static_cast<std::size_t>(11 * v);
}

/// Where a stream is: the words that its key is the hash of.
struct Place {
    std::uint64_t seed = 1, step = 0, bounce = 0, patch = 0;

    /// As Bounces and GroupedRays find it.
    [[nodiscard]] std::uint64_t key() const {
        return hash_words({hash_words({seed, step, bounce}), patch});
    }
    /// That of the line on which the rays of a bounce stand.
    [[nodiscard]] std::uint64_t line() const { return hash_words({seed, step, bounce}); }
};

/// The place of one stream after the other, along one of the words.
Place along(std::size_t word, std::uint64_t number) {
    Place place{17, 3, 2, 1000};
    *std::array{&place.seed, &place.step, &place.bounce, &place.patch}[word] += number;
    return place;
}

/// The first `count` coordinates of where the rays of a stream start.
std::vector<double> starts(std::uint64_t key, std::size_t count) {
    static const Hemisphere hemisphere(0);
    static const CellDirections directions(hemisphere, CellArea::projected_solid_angle);
    const auto batch = std::make_unique<DirectionBatch>();
    for (std::uint32_t k = 0; k < count; ++k)
        batch->add(key, k, whole_hemisphere);
    directions.draw(*batch);
    return {batch->u.begin(), batch->u.begin() + static_cast<std::ptrdiff_t>(count)};
}

constexpr std::uint64_t pairs_of_streams = 2000;
constexpr std::size_t numbers_each = 12;

/// The p-value of pairs of a number from one stream and one from the next, `lag` places later.
double p_of_neighbours(std::size_t lag,
                       const std::function<std::vector<double>(std::uint64_t)>& stream) {
    std::vector<std::uint64_t> counts(parts.size());
    for (std::uint64_t k = 0; k < pairs_of_streams; ++k) {
        const std::vector<double> a = stream(2 * k), b = stream(2 * k + 1);
        for (std::size_t n = 0; n + lag < numbers_each; ++n)
            ++counts[part_of(a[n], b[n + lag])];
    }
    return chi_square(counts, parts).p_value;
}

} // namespace

TEST_CASE("Streams of consecutive seeds, steps, bounces and patches have nothing in common") {
    for (std::size_t word = 0; word < 4; ++word)
        for (const std::size_t lag : {0u, 1u, 2u}) {
            CAPTURE(word, lag);
            CHECK(p_of_neighbours(lag, [&](std::uint64_t k) {
                      return starts(along(word, k).key(), numbers_each);
                  }) > sidak(significance, 12));
        }
    // Copies that are shifted by one are found.
    const auto shifted = [](std::uint64_t k) {
        std::vector<double> numbers = starts(Place{1, 2, 3, k / 2}.key(), numbers_each + 1);
        numbers.erase(k % 2 == 0 ? numbers.begin() : numbers.end() - 1);
        return numbers;
    };
    CHECK(p_of_neighbours(1, shifted) < 1e-9);
}

TEST_CASE("The lines of consecutive seeds, steps and bounces begin anywhere") {
    for (std::size_t word = 0; word < 3; ++word) {
        std::uint64_t number = 0;
        CAPTURE(word);
        CHECK(chi_square(40'000, parts, [&] {
                  const double a = Rng(along(word, number).line()).uniform();
                  const double b = Rng(along(word, number + 1).line()).uniform();
                  number += 2;
                  return part_of(a, b);
              }).p_value > sidak(significance, 3));
    }
}

TEST_CASE("Hemispheres are turned by any angle, whatever that of the patch before") {
    const Mesh mesh(furnace_box(45, .5)); // 12 150 patches
    std::vector<double> turn;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Frame plain = Frame::from_normal(mesh.patches()[i].normal);
        const Vec3 x = plain.to_local(mesh.hemisphere_frame(i).x);
        REQUIRE(std::abs(x.z) < 1e-12);
        turn.push_back(std::atan2(x.y, x.x) / (2 * std::numbers::pi) + .5);
    }
    for (const std::size_t lag : {1u, 2u, 45u}) { // 45: the patch in the next row
        std::vector<std::uint64_t> counts(parts.size());
        for (std::size_t i = 0; i + lag < turn.size(); ++i)
            if (i / lag % 2 == 0)
                ++counts[part_of(turn[i], turn[i + lag])];
        CAPTURE(lag);
        CHECK(chi_square(counts, parts).p_value > sidak(significance, 3));
    }
}

TEST_CASE("Pairs are looked at as often as they are due, and count as much more") {
    const Model model(room_with_block());
    const SolveOptions options;
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const std::size_t patches = model.mesh.patches().size();
    std::uint32_t lamp = 0;
    while (!(model.mesh.material(lamp).emission.x > 0))
        ++lamp;
    constexpr int looks = 2000;

    ShotFactors seldom(input, 1);
    std::vector<MeanTest> factor(patches);
    std::vector<double> looked_at(patches), chance(patches, 1);
    std::vector<bool> last(patches);
    double together = 0, variance_together = 0; // of neighbours, and of a pair and the next seed
    double in_turn = 0, variance_in_turn = 0;
    for (int k = 0; k < looks; ++k) {
        seldom.look(lamp, Vec3(1.0), .02, static_cast<std::uint64_t>(k));
        double before = 0, variance_before = 0;
        for (std::uint32_t i = 0; i < patches; ++i) {
            const ReceiverFactor& sight = seldom.by_receiver()[i];
            factor[i].add(sight.factor);
            if (!(sight.at_risk > 0)) {
                variance_before = 0;
                continue;
            }
            // Of ReceiverFactor: at_risk = rough / S, left_to_chance = (1 - p) / p rough^2 / S.
            const double rough =
                std::min(rough_factor(model.mesh.patches()[i], model.mesh.patches()[lamp]),
                         model.mesh.patches()[lamp].area / model.mesh.patches()[i].area);
            const double p = chance[i] = 1 / (1 + sight.left_to_chance / (rough * sight.at_risk));
            const bool looked = sight.points > 0;
            looked_at[i] += looked;
            const double off = looked - p, variance = p * (1 - p);
            together += off * before;
            variance_together += variance * variance_before;
            if (k > 0) {
                in_turn += off * (last[i] - p);
                variance_in_turn += variance * variance;
            }
            last[i] = looked;
            before = off;
            variance_before = variance;
        }
    }
    ShotFactors all(input, 1);
    std::vector<MeanTest> exact(patches);
    for (std::uint64_t k = 0; k < 16; ++k) {
        all.look(lamp, Vec3(1.0), 1e4, 1'000'000 + k);
        for (std::uint32_t i = 0; i < patches; ++i)
            exact[i].add(all.by_receiver()[i].factor);
    }

    std::size_t by_chance = 0;
    for (std::uint32_t i = 0; i < patches; ++i)
        by_chance += chance[i] < 1;
    REQUIRE(by_chance > 20);
    const double alpha = sidak(significance, 2 * by_chance + 2);
    for (std::uint32_t i = 0; i < patches; ++i) {
        if (!(chance[i] < 1))
            continue;
        CAPTURE(i, chance[i], looked_at[i], factor[i].mean(), exact[i].mean());
        CHECK(normal_p_value((looked_at[i] - looks * chance[i]) /
                             std::sqrt(looks * chance[i] * (1 - chance[i]))) > alpha);
        const double error = std::hypot(factor[i].standard_error(), exact[i].standard_error());
        if (looked_at[i] > 30 && error > 0) // else the mean is far from normal
            CHECK(normal_p_value((factor[i].mean() - exact[i].mean()) / error) > alpha);
    }
    CHECK(normal_p_value(together / std::sqrt(variance_together)) > alpha);
    CHECK(normal_p_value(in_turn / std::sqrt(variance_in_turn)) > alpha);
}

TEST_CASE("A patch shoots the whole number below or above its share of rays, as often as due") {
    // Six sides of 3 x 3 patches, some of which hold a part of one ray.
    std::vector<Material> materials;
    for (const double emission : {1.0, .4, .27, .11, .013, .0021})
        materials.push_back({"of " + std::to_string(emission), Vec3(0.0), Vec3(emission)});
    const Model model(box_room(Vec3(0.0), Vec3(1.0), 3, materials, {0, 1, 2, 3, 4, 5}));
    const auto patches = static_cast<double>(model.mesh.patches().size());
    SolveOptions options;
    options.rays = 7;
    double power = 0;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
        power += model.mesh.patches()[i].area * model.mesh.material(i).emission.x;
    constexpr int steps = 600;
    for (const char* method : {"monte-carlo", "progressive-monte-carlo", "stratified"}) {
        Steps run(model, *find_method(method), options);
        (void)run.next();
        std::vector<double> above(model.mesh.patches().size()), last(above.size());
        double in_turn = 0, variance = 0;
        const auto expected = [&](std::uint32_t i) {
            return options.rays * patches * model.mesh.patches()[i].area *
                   model.mesh.material(i).emission.x / power;
        };
        for (int k = 0; k < steps; ++k)
            for (const StepRays& from : run.next()) {
                const double whole = std::floor(expected(from.patch));
                const double share = expected(from.patch) - whole;
                const double more = static_cast<double>(from.rays.size()) - whole;
                CAPTURE(method, from.patch, expected(from.patch));
                REQUIRE((more == 0 || more == 1));
                above[from.patch] += more;
                if (k > 0) {
                    in_turn += (more - share) * (last[from.patch] - share);
                    variance += share * share * (1 - share) * (1 - share);
                }
                last[from.patch] = more;
            }
        for (std::uint32_t i = 0; i < above.size(); ++i) {
            const double share = expected(i) - std::floor(expected(i));
            CAPTURE(method, i, expected(i), above[i]);
            CHECK(normal_p_value((above[i] - steps * share) /
                                 std::sqrt(steps * share * (1 - share))) >
                  sidak(significance, 3 * above.size()));
        }
        // Patches of a step stand on one line, so their roulettes go together: by at most as much
        // as if all were one.
        CAPTURE(method, in_turn, variance);
        CHECK(std::abs(in_turn) < 4 * std::sqrt(variance * patches));
    }
}
