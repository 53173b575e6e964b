// Which emitters shadow rays go to.
#include "radiosity/direct_light.h"
#include "radiosity/emitter_choice.h"
#include "radiosity/pair_factor.h"
#include "radiosity/shot.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace hemilux;
using test::Model;

namespace {

/// Chances of all emitters, as told by a fine sweep through [0, 1) and as met in it.
struct Sweep {
    static constexpr int steps = 40'000;
    std::vector<double> told, met;

    Sweep(const EmitterChoice& choice, const EmitterChoice::Cut& cut, std::size_t emitters)
        : told(emitters), met(emitters) {
        for (int k = 0; k < steps;) {
            std::array<double, samples_per_block> u;
            for (double& each : u)
                each = (k++ + .5) / steps;
            EmitterChoice::Choices choices;
            choice.choose(cut, u.data(), choices);
            for (const auto& [e, chance] : choices) {
                met[e] += 1.0 / steps;
                told[e] = chance;
            }
        }
    }
};

} // namespace

TEST_CASE("Shadow rays go to every emitter that may be seen, by what it may bring") {
    // Walls and blocks are lamps: some behind each other's backs, some around a corner.
    Scene scene = test::room_with_block();
    for (Material& material : scene.materials)
        material.emission += material.reflectance;
    const Model model(std::move(scene));
    const std::span<const Patch> patches = model.mesh.patches();
    std::vector<std::uint32_t> emitters(patches.size());
    std::iota(emitters.begin(), emitters.end(), 0u);
    REQUIRE(emitters.size() <= 1024); // weighed one by one
    const EmitterChoice choice(model.mesh, emitters);
    EmitterChoice::Cut cut;
    for (std::uint32_t i = 0; i < patches.size(); i += 7) {
        choice.weigh(i, cut);
        if (cut.dark())
            continue;
        const Sweep sweep(choice, cut, emitters.size());
        std::vector<double> expected(emitters.size());
        double sum = 0;
        for (std::size_t e = 0; e < emitters.size(); ++e) {
            const Patch &to = patches[i], &from = patches[emitters[e]];
            const double r = glm::distance(to.centre, from.centre);
            const double nearest = std::max(r - radius_of(to), 0.0), pi = std::numbers::pi;
            if (emitters[e] != i && may_see(to, from))
                expected[e] =
                    mean_of_channels(model.mesh.material(emitters[e]).emission) *
                    rough_factor(to, from) *
                    std::sqrt((pi * r * r + from.area) / (pi * nearest * nearest + from.area));
            sum += expected[e];
        }
        for (std::size_t e = 0; e < emitters.size(); ++e)
            if (sweep.met[e] > 0)
                CHECK(sweep.told[e] == Approx(expected[e] / sum).epsilon(1e-9));
            else
                CHECK(expected[e] / sum < 2.0 / Sweep::steps);
    }
}

TEST_CASE("Direct light is unbiased where emitters are drawn by clusters") {
    const Scene scene = test::room_with_block();
    const Model whole(scene), fine(scene, {.max_edge = .018}); // the lamp in 1156 patches
    const std::vector<std::uint32_t> emitters = small_emitters(fine.mesh);
    REQUIRE(emitters.size() > 1024);
    const std::size_t n = fine.mesh.patches().size();
    Monitor monitor;
    const Workers workers(2);
    const EmitterChoice choice(fine.mesh, emitters);
    EmitterChoice::Cut cut;
    for (std::uint32_t i = 0; i < n; i += 97) {
        choice.weigh(i, cut);
        if (cut.dark())
            continue;
        const auto [told, met] = Sweep(choice, cut, emitters.size());
        for (std::size_t e = 0; e < met.size(); ++e)
            CHECK(met[e] == Approx(told[e]).margin(2.0 / Sweep::steps));
        CHECK(std::accumulate(told.begin(), told.end(), 0.0) == Approx(1).epsilon(.01));
    }
    // All light that arrives, whether the lamp is one patch or many.
    const auto light_of = [&](const Model& model, std::uint32_t samples) {
        const std::vector<std::uint32_t> lamps = small_emitters(model.mesh);
        DirectLight light(model.mesh, model.bvh, everything_needed, lamps, {5});
        light.sample_up_to(std::vector<std::uint32_t>(model.mesh.patches().size(), samples),
                           workers, monitor);
        Vec3 power(0.0);
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i)
            power += model.mesh.patches()[i].area * light.irradiance(i);
        return power;
    };
    const Vec3 coarse_power = light_of(whole, 1u << 14), fine_power = light_of(fine, 64);
    for (int c = 0; c < 3; ++c)
        CHECK(fine_power[c] == Approx(coarse_power[c]).epsilon(.01));
}
