// Lamps apart: which there are, and that the light of each is that of the scene with it alone.
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/stored_transport/stored_transport_method.h"
#include "radiosity/light/lamps/lamp_layers.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include "parallel/workers.h"

#include <cmath>
#include <memory>

using namespace hemilux;
using test::Model;

namespace {

void add_lamp(Scene& scene, double x, double z, double half, std::uint32_t material,
              std::uint32_t group) {
    constexpr double y = .99;
    test::add_quad(scene, {x - half, y, z - half}, {x + half, y, z - half}, {x + half, y, z + half},
                   {x - half, y, z + half}, 1, 1, material);
    scene.facets.back().group = group;
}

/// A room with three lamps of two materials in one group, another in a group of its own, and a
/// large glowing wall panel.
Scene room_of_lamps() {
    Scene scene =
        test::box_room({0, 0, 0}, {2, 1, 2}, 6, {{"wall", Vec3(.5), Vec3(0)}}, {0, 0, 0, 0, 0, 0});
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({"warm", Vec3(0), Vec3(30, 20, 10)});
    scene.materials.push_back({"cold", Vec3(.2), Vec3(5, 10, 40)});
    scene.materials.push_back({"panel", Vec3(.3), Vec3(.5, 1, .2)});
    scene.groups.push_back("lamps");
    scene.groups.push_back("desk");
    const auto groups = static_cast<std::uint32_t>(scene.groups.size());
    add_lamp(scene, .4, .4, .1, first, groups - 2);
    add_lamp(scene, 1.5, .4, .1, first, groups - 2);
    add_lamp(scene, .4, 1.5, .05, first + 1, groups - 2);
    add_lamp(scene, 1.5, 1.5, .1, first + 1, groups - 1);
    test::add_quad(scene, {.01, .1, .2}, {.01, .9, .2}, {.01, .9, 1.8}, {.01, .1, 1.8}, 1, 1,
                   first + 2);
    scene.facets.back().group = groups - 1;
    add_point_emitter(scene,
                      {.name = "bulb", .position = {1, .5, 1}, .intensity = Vec3(.3, .2, .1)});
    return scene;
}

double total_power(const LampLayers& lamps) {
    double sum = 0;
    for (const LampLayer& layer : lamps.layers)
        sum += layer.power.x;
    return sum;
}

LampPatches solve_layers(const Model& model, const Solver& solver) {
    const auto* const keeps_rays = dynamic_cast<const KeepsRays*>(&solver);
    REQUIRE(keeps_rays);
    const std::unique_ptr<Relighting> rays = keeps_rays->relighting(Workers(2));
    LampPatches light{find_lamp_layers(model.mesh, LayersBy::lamp), {}};
    for (std::uint32_t k = 0; k < light.lamps.layers.size(); ++k)
        light.patches.push_back(
            *rays->light_of(lit_by_layer(model.mesh, light.lamps, k), .3, Workers(2)));
    return light;
}

/// The relative difference of what two solutions say is reflected.
double difference(const Mesh& mesh, const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double off = 0, all = 0;
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        const Vec3 own = b[i] - mesh.material(i).emission, by = a[i] - b[i];
        off += mesh.patches()[i].area * glm::dot(by, by);
        all += mesh.patches()[i].area * glm::dot(own, own);
    }
    return std::sqrt(off / all);
}

} // namespace

TEST_CASE("lamps are faces that touch, all of a group, or all of a material") {
    const Mesh mesh{room_of_lamps()};
    const LampLayers lamps = find_lamp_layers(mesh, LayersBy::lamp);
    std::vector<std::string> names;
    for (const LampLayer& layer : lamps.layers)
        names.push_back(layer.name);
    CHECK(names ==
          std::vector<std::string>{"lamps", "lamps 2", "lamps 3", "desk", "desk 2", "bulb"});
    const LampLayers groups = find_lamp_layers(mesh, LayersBy::group);
    CHECK(groups.layers.size() == 3);
    const LampLayers materials = find_lamp_layers(mesh, LayersBy::material);
    REQUIRE(materials.layers.size() == 4);
    CHECK(materials.layers[1].name == "cold");
    CHECK(materials.layers[0].power.x == Approx(2 * .04 * 30));
    CHECK(total_power(lamps) == Approx(total_power(groups)));
    CHECK(total_power(lamps) == Approx(total_power(materials)));
}

TEST_CASE("a mesh lit by a layer is the same but for what is emitted") {
    const Mesh mesh{room_of_lamps()};
    const LampLayers lamps = find_lamp_layers(mesh, LayersBy::lamp);
    std::vector<Vec3> sum(mesh.patches().size(), Vec3(0.0));
    std::size_t points = 0;
    for (std::uint32_t k = 0; k < lamps.layers.size(); ++k) {
        const Mesh lit = lit_by_layer(mesh, lamps, k);
        REQUIRE(lit.patches().size() == mesh.patches().size());
        points += point_emitters_of(lit.scene()).size();
        for (std::uint32_t i = 0; i < sum.size(); ++i) {
            CHECK(lit.material(i).reflectance == mesh.material(i).reflectance);
            sum[i] += lit.material(i).emission;
        }
    }
    for (std::uint32_t i = 0; i < sum.size(); ++i)
        CHECK(sum[i] == mesh.material(i).emission);
    CHECK(points == 1);
}

TEST_CASE("the light of each lamp is that of a run with it alone, and all add up") {
    const Model model{room_of_lamps()};
    Monitor monitor;
    SolveOptions options;
    options.stop.error = .01;
    const SolverInput input{model.mesh, model.bvh, options, monitor};
    const auto solver = stored_transport_method.make(input);
    REQUIRE(run(*solver, input, options.stop));
    LampPatches light = solve_layers(model, *solver);
    const Solution& whole = solver->solution();
    share_whole(model.mesh, whole, light);
    for (std::uint32_t i = 0; i < whole.radiosity.size(); ++i) {
        Vec3 sum(0.0);
        for (const Relit& layer : light.patches)
            sum += layer.radiosity[i];
        for (int c = 0; c < 3; ++c)
            REQUIRE(sum[c] == Approx(whole.radiosity[i][c]).epsilon(1e-12));
    }
    for (std::uint32_t k = 0; k < light.patches.size(); ++k) {
        const Mesh alone = lit_by_layer(model.mesh, light.lamps, k);
        SolveOptions exact = options;
        exact.seed = 77;
        exact.stop.error = .002;
        const SolverInput other{alone, model.bvh, exact, monitor};
        const auto reference = stored_transport_method.make(other);
        REQUIRE(run(*reference, other, exact.stop));
        double told = 0, all = 0;
        for (std::uint32_t i = 0; i < whole.radiosity.size(); ++i) {
            const Vec3 own = light.patches[k].radiosity[i] - alone.material(i).emission;
            told += alone.patches()[i].area * glm::dot(light.patches[k].standard_error[i],
                                                       light.patches[k].standard_error[i]);
            all += alone.patches()[i].area * glm::dot(own, own);
        }
        const double error = std::sqrt(told / all);
        const double off =
            difference(alone, light.patches[k].radiosity, reference->solution().radiosity);
        CAPTURE(light.lamps.layers[k].name, error, off);
        CHECK(error < .06);
        CHECK(off < 2 * error + .002);
        CHECK(off > .2 * error - .002);
    }
}
