// Which emitters shadow rays go to.
#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/emitters/emitter_choice.h"
#include "radiosity/engine/emitters/small_emitters.h"
#include "radiosity/engine/factors/pairs/pair_factor.h"
#include "radiosity/paper/rays/shot.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

using namespace hemilux;
using test::Model;

namespace {

/// Chances of all emitters, as stated by a fine sweep through [0, 1) and as met in it.
struct Sweep {
    static constexpr int steps = 40'000;
    std::vector<double> stated, met;

    Sweep(const EmitterChoice& choice, const EmitterChoice::Cut& cut, std::size_t emitters)
        : stated(emitters), met(emitters) {
        for (int k = 0; k < steps;) {
            std::array<double, samples_per_block> u;
            for (double& each : u)
                each = (k++ + .5) / steps;
            EmitterChoice::Choices choices;
            choice.choose(cut, u.data(), choices);
            for (const auto& [e, chance] : choices) {
                met[e] += 1.0 / steps;
                stated[e] = chance;
            }
        }
    }
};

std::vector<Patch> small_emitting_patches(const Mesh& mesh) {
    std::vector<Patch> emitters;
    for (const std::uint32_t e : small_emitters(mesh))
        emitters.push_back(mesh.patches()[e]);
    return emitters;
}

/// What arrives straight from the emitters, by patch.
std::vector<Vec3> direct_light(const Model& model, std::uint32_t samples) {
    const std::vector<std::uint32_t> emitters = small_emitters(model.mesh);
    DirectLight light(model.mesh, model.bvh, everything_needed, emitters, {5});
    const std::size_t n = model.mesh.patches().size();
    Monitor monitor;
    light.sample_up_to(std::vector<std::uint32_t>(n, samples), Workers(2), monitor);
    std::vector<Vec3> found;
    for (std::uint32_t i = 0; i < n; ++i)
        found.push_back(light.irradiance(i));
    return found;
}

Vec3 power_of(const Model& model, std::span<const Vec3> light) {
    Vec3 power(0.0);
    for (std::size_t i = 0; i < light.size(); ++i)
        power += model.mesh.patches()[i].area * light[i];
    return model.mesh.frame().area_to_world(1.0) * power;
}

/// Of the centre and the corners of one over the plane of the other.
double min_height(const Patch& of, const Patch& over) {
    double least = glm::dot(over.normal, of.centre - over.centre);
    for (const Vec3& corner : of.shape.corner)
        least = std::min(least, glm::dot(over.normal, corner - over.centre));
    return least;
}

/// With each patch as a facet.
Scene made_of_patches(const Mesh& mesh) {
    Scene scene;
    scene.materials = mesh.scene().materials;
    for (const Patch& patch : mesh.patches()) {
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (const Vec3& corner : patch.shape.corner)
            scene.vertices.push_back(mesh.frame().to_world(corner));
        scene.facets.push_back({{first, first + 1, first + 2, first + 3}, 0, patch.material, 0});
    }
    return scene;
}

} // namespace

TEST_CASE("Shadow rays go to every emitter that may be seen, by what it may bring") {
    // Walls and blocks are lamps: some behind each other's backs, some around a corner.
    Scene scene = test::room_with_block();
    for (Material& material : scene.materials)
        material.emission += material.reflectance;
    const Model model(std::move(scene));
    const std::span<const Patch> patches = model.mesh.patches();
    REQUIRE(patches.size() <= 1024); // weighed one by one
    const EmitterChoice choice(model.mesh, patches);
    Vec3 most(0.0); // each channel counts alike
    for (const Patch& patch : patches)
        most = glm::max(most, model.mesh.material(patch).emission);
    EmitterChoice::Cut cut;
    for (std::uint32_t i = 0; i < patches.size(); i += 7) {
        choice.weigh(i, cut);
        if (cut.dark())
            continue;
        const Sweep sweep(choice, cut, patches.size());
        std::vector<double> expected(patches.size());
        double sum = 0;
        for (std::size_t e = 0; e < patches.size(); ++e) {
            const Patch &to = patches[i], &from = patches[e];
            const double r = glm::distance(to.centre, from.centre), pi = std::numbers::pi;
            const double nearest =
                std::max({r - radius_of(to), min_height(from, to), min_height(to, from), 0.0});
            if (e != i && may_see(to, from))
                expected[e] =
                    mean_of_channels(model.mesh.material(from).emission / most) *
                    rough_factor(to, from) *
                    std::sqrt((pi * r * r + from.area) / (pi * nearest * nearest + from.area));
            sum += expected[e];
        }
        for (std::size_t e = 0; e < patches.size(); ++e)
            if (sweep.met[e] > 0)
                CHECK(sweep.stated[e] == Approx(expected[e] / sum).epsilon(1e-9));
            else
                CHECK(expected[e] / sum < 2.0 / Sweep::steps);
    }
}

TEST_CASE("Direct light is unbiased where emitters are drawn by clusters", "[slow]") {
    const Scene scene = test::room_with_block();
    const Model whole(scene), divided(scene, {.max_edge = .018});
    const Model fine(made_of_patches(divided.mesh)); // the lamp in 1156
    const std::size_t n = fine.mesh.patches().size();
    const std::vector<Patch> emitters = small_emitting_patches(fine.mesh);
    REQUIRE(emitters.size() > 1024);
    const EmitterChoice choice(fine.mesh, emitters);
    EmitterChoice::Cut cut;
    for (std::uint32_t i = 0; i < n; i += 97) {
        choice.weigh(i, cut);
        if (cut.dark())
            continue;
        const auto [stated, met] = Sweep(choice, cut, emitters.size());
        for (std::size_t e = 0; e < met.size(); ++e)
            CHECK(met[e] == Approx(stated[e]).margin(2.0 / Sweep::steps));
        CHECK(std::accumulate(stated.begin(), stated.end(), 0.0) == Approx(1).epsilon(.01));
    }
    const Vec3 of_one = power_of(whole, direct_light(whole, 1u << 14));
    const Vec3 of_many = power_of(fine, direct_light(fine, 64));
    for (int c = 0; c < 3; ++c)
        CHECK(of_many[c] == Approx(of_one[c]).epsilon(.01));
}

namespace {

/// A floor, and far above it 40 x 40 lamps; every other one emits nine times as much.
Scene many_lamps() {
    Scene scene;
    scene.materials = {
        {"floor", Vec3(.5), Vec3(0.0)}, {"dim", Vec3(.1), Vec3(1.0)}, {"lit", Vec3(.1), Vec3(9.0)}};
    scene.groups = {"all"};
    test::add_quad(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 1, 1, 0);
    const std::size_t before = scene.facets.size();
    test::add_quad(scene, {-1, 9, -1}, {1, 9, -1}, {1, 9, 1}, {-1, 9, 1}, 40, 40, 1);
    for (std::size_t f = before; f < scene.facets.size(); ++f)
        scene.facets[f].material = 1 + (f + f / 40) % 2;
    return scene;
}

} // namespace

TEST_CASE("Within a cluster each emitter has the chance that is stated, and by its power") {
    const Mesh mesh(many_lamps());
    const std::vector<Patch> emitters(mesh.patches().begin() + 1, mesh.patches().end());
    REQUIRE(emitters.size() == 1600);
    const EmitterChoice choice(mesh, emitters);
    EmitterChoice::Cut cut;
    choice.weigh(0, cut);
    REQUIRE(cut.clusters.size() < emitters.size() / 8); // some a dozen to a cluster
    const auto [stated, met] = Sweep(choice, cut, emitters.size());
    double all = 0, lit = 0;
    for (std::size_t e = 0; e < emitters.size(); ++e) {
        CHECK(met[e] == Approx(stated[e]).margin(2.0 / Sweep::steps));
        all += stated[e];
        lit += mesh.material(emitters[e]).emission.x > 1 ? stated[e] : 0;
    }
    CHECK(all == Approx(1).epsilon(.01));
    CHECK(lit == Approx(.9).epsilon(.02)); // nine of ten parts of the power
}

TEST_CASE("Shadow rays do not pay where many emitters touch a surface") {
    const Model lamp(test::room_with_block());
    for (const std::uint32_t strips : {12u, 40u}) { // 144 are weighed one by one, 1600 by clusters
        const Model model(test::curtain_at_wall(strips));
        std::vector<std::uint32_t> touched;
        for (const Model* each : {&model, &lamp}) {
            const std::vector<Patch> emitters = small_emitting_patches(each->mesh);
            const EmitterChoice choice(each->mesh, emitters);
            EmitterChoice::Cut cut;
            for (std::uint32_t i = 0; i < each->mesh.patches().size(); ++i) {
                choice.weigh(i, cut);
                if (!cut.pays()) {
                    CHECK(each == &model);
                    touched.push_back(i);
                }
            }
        }
        CAPTURE(strips, touched.size());
        // The patch of the wall that the curtain touches, and perhaps neighbours.
        CHECK(std::ranges::count(touched, test::wall_behind_curtain) == 1);
        CHECK(touched.size() < 24);
        DirectLight light(model.mesh, model.bvh, everything_needed, small_emitters(model.mesh),
                          {5});
        Monitor monitor;
        light.sample_up_to(std::vector<std::uint32_t>(model.mesh.patches().size(), 16), Workers(2),
                           monitor);
        for (const std::uint32_t i : touched)
            CHECK(light.samples(i) == 0);
        CHECK(light.samples(0) == 16);
    }
}

TEST_CASE("A lamp is one emitter however finely its patches divide it") {
    Scene scene;
    scene.materials = {{"ground", Vec3(.5), Vec3(0.0)}, {"lamp", Vec3(.1), Vec3(1.0)}};
    test::add_quad(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 8, 8, 0);
    test::add_quad(scene, {-.3, 1, -.3}, {.3, 1, -.3}, {.3, 1, .3}, {-.3, 1, .3}, 1, 1, 1);
    // Pieces of .25 leave the ground as it is and make 9 of the lamp.
    for (const bool two_sided : {false, true}) {
        const std::size_t sides = two_sided ? 2 : 1, ground = 64 * sides;
        std::vector<Vec3> of_whole = direct_light(Model(scene, {.two_sided = two_sided}), 16);
        std::vector<Vec3> of_divided =
            direct_light(Model(scene, {.max_edge = .25, .two_sided = two_sided}), 16);
        REQUIRE(of_whole.size() == ground + sides);
        REQUIRE(of_divided.size() == ground + 9 * sides);
        of_whole.resize(ground);
        of_divided.resize(ground);
        CHECK(of_whole == of_divided);
        CHECK(of_whole[0].x > 0);
    }
}
