// Panes: what passes them along one ray, and in the solutions of all methods.
#include "radiosity/engine/rays/panes.h"

#include "bvh/brute_force.h"
#include "geometry/frame.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/solving/method_option.h"
#include "radiosity/paper/rays/shot.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/closed_forms.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace hemilux;

namespace {

/// A parallelogram that lets light through.
Pane pane(const Vec3& corner, const Vec3& first, const Vec3& second, double transmittance) {
    return {{corner, corner + first, corner + first + second, corner + second}, transmittance};
}

/// A mesh with panes and the tracer that the program makes for it.
struct Model {
    Mesh mesh;
    MadeTracer made;
    Model(Scene scene, const std::vector<Pane>& panes)
        : mesh([&] {
              scene.panes = std::make_shared<const std::vector<Pane>>(panes);
              return Mesh(std::move(scene));
          }()),
          made(make_tracer(mesh)) {}
    [[nodiscard]] const Tracer& tracer() const { return *made.tracer; }
};

/// Two unit squares that face each other at distance 1, so that the local frame is the world's but
/// for its origin. The first one shines.
Scene two_plates(double rho) {
    Scene scene;
    scene.materials = {{"lamp", Vec3(rho), Vec3(1)}, {"plate", Vec3(rho), Vec3(0)}};
    scene.groups = {"default"};
    test::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, 0);
    test::add_quad(scene, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 1, 1, 1);
    scene.faces = 2;
    return scene;
}

Pane between_plates(double z, double transmittance) {
    return pane({-1, -1, z}, {3, 0, 0}, {0, 3, 0}, transmittance);
}

/// The share of rays from all over the first plate, straight up, that come to the second one.
double arriving(const Model& model) {
    constexpr int rays = 20'000;
    Rng rng(7);
    int count = 0;
    for (int k = 0; k < rays; ++k) {
        const Vec3 from(rng.uniform(), rng.uniform(), 0);
        const auto hit = model.tracer().closest(
            {.origin = model.mesh.frame().to_local(from), .direction = {0, 0, 1}, .from = 0});
        count += hit ? 1 : 0;
    }
    return double(count) / rays;
}

/// Another way to the same solution: factors by rays against all facets, with the panes' planes cut
/// by hand, and the equations by repeated substitution.
std::vector<double> by_brute_force(const Mesh& mesh, const std::vector<Pane>& panes, int rays) {
    const std::size_t n = mesh.patches().size();
    const BruteForce tracer(mesh.soup());
    std::vector<double> factor(n * n);
    Rng rng(11);
    for (std::uint32_t i = 0; i < n; ++i)
        for (int k = 0; k < rays; ++k) {
            const Patch& patch = mesh.patches()[i];
            const Ray ray{.origin = patch.shape.sample({rng.uniform(), rng.uniform()}),
                          .direction =
                              Frame::from_normal(patch.normal).to_world(sample_cosine(rng)),
                          .from = patch.facet};
            const auto hit = tracer.closest(ray);
            if (!hit || mesh.patch_at(*hit) == none)
                continue;
            const Vec3 from = mesh.frame().to_world(ray.origin);
            const Vec3 way = hit->t / mesh.frame().scale * ray.direction;
            double share = 1.0 / rays;
            for (const Pane& p : panes) {
                const Vec3 u = p.corner[1] - p.corner[0], v = p.corner[3] - p.corner[0];
                const Vec3 normal = glm::cross(u, v);
                const double t = glm::dot(p.corner[0] - from, normal) / glm::dot(way, normal);
                const Vec3 at = from + t * way - p.corner[0];
                const double a = glm::dot(at, u) / glm::dot(u, u),
                             b = glm::dot(at, v) / glm::dot(v, v);
                if (t > 0 && t < 1 && a > 0 && a < 1 && b > 0 && b < 1)
                    share *= p.transmittance;
            }
            factor[i * n + mesh.patch_at(*hit)] += share;
        }
    std::vector<double> light(n);
    for (int round = 0; round < 200; ++round)
        for (std::uint32_t i = 0; i < n; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < n; ++j)
                sum += factor[i * n + j] * light[j];
            light[i] = mesh.material(i).emission.r + mesh.material(i).reflectance.r * sum;
        }
    return light;
}

/// Each method by its name, and those with other factors.
struct Run {
    const Method* method;
    std::string factors; ///< of --factors; empty: its own
};
std::vector<Run> all_runs() {
    std::vector<Run> runs;
    for (const Method* method : methods())
        runs.push_back({method, ""});
    runs.push_back({find_method("matrix"), "exact"});
    return runs;
}

Solution solve(const Model& model, const Run& run, double error) {
    SolveOptions options;
    options.seed = 3;
    for (const MethodOption& option : run.method->own_options())
        if (!run.factors.empty() && option.name == "--factors")
            REQUIRE(option.set(options, run.factors));
    Monitor monitor;
    const Needs needs = find_needs(model.mesh);
    const SolverInput input{model.mesh, model.tracer(), options, monitor, needs};
    const auto solver = run.method->make(input);
    hemilux::run(*solver, input, {.steps = {}, .seconds = 60, .error = error});
    return solver->solution();
}

} // namespace

TEST_CASE("A ray passes panes by the product of their transmittances") {
    const Vec3 middle(.5, .5, 0);
    const auto passed = [&](const std::vector<Pane>& panes, double t_max) {
        const Model model(two_plates(.5), panes);
        return model.tracer().passed({.origin = model.mesh.frame().to_local(middle),
                                      .direction = {0, 0, 2}, // of any length
                                      .t_max = t_max * model.mesh.frame().scale / 2});
    };
    CHECK(passed({between_plates(.3, .7)}, 1) == .7);
    CHECK(passed({between_plates(.3, .7), between_plates(.6, .7)}, 1) == Approx(.49));
    CHECK(passed({between_plates(.3, .7), between_plates(.6, .7)}, .5) == .7);
    CHECK(passed({between_plates(.3, .7), between_plates(.6, 0)}, 1) == 0);
    CHECK(passed({between_plates(1.5, .7)}, 1) == 1);
    CHECK(passed({pane({2, 0, .5}, {1, 0, 0}, {0, 1, 0}, .7)}, 1) == 1);
    // Both faces of one pane, as exporters write it, and a pane that lies on a plate.
    Pane behind = between_plates(.3, .7);
    std::swap(behind.corner[1], behind.corner[3]);
    CHECK(passed({between_plates(.3, .7), behind}, 1) == .7);
    CHECK(passed({between_plates(0, .7), between_plates(1, .7)}, 1) == 1);
}

TEST_CASE("Rays end in panes by chance, each ray always alike") {
    CHECK(arriving(Model(two_plates(.5), {})) == 1);
    CHECK(arriving(Model(two_plates(.5), {between_plates(.3, .7)})) == Approx(.7).margin(.01));
    const Model two(two_plates(.5), {between_plates(.3, .7), between_plates(.6, .5)});
    CHECK(arriving(two) == Approx(.35).margin(.011));
    CHECK(arriving(Model(two_plates(.5), {between_plates(.3, 1)})) == 1);
    CHECK(arriving(Model(two_plates(.5), {between_plates(.3, 0)})) == 0);
    CHECK(arriving(two) == arriving(two));

    Rng rng(5);
    std::vector<Ray> rays;
    for (int k = 0; k < 1000; ++k)
        rays.push_back(
            {.origin = two.mesh.patches()[0].shape.sample({rng.uniform(), rng.uniform()}),
             .direction = Frame::from_normal({0, 0, 1}).to_world(sample_cosine(rng)),
             .from = 0});
    std::vector<FacetHit> hits(rays.size());
    two.tracer().closest_stream(rays, hits);
    const std::vector<std::uint32_t> targets(rays.size(), none);
    std::vector<std::uint8_t> blocked(rays.size());
    two.tracer().occluded_stream(rays, targets, blocked);
    std::vector<std::uint32_t> pierced(rays.size());
    two.tracer().count_stream(rays, pierced);
    std::size_t differ = 0, stopped = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        differ += hits[k].facet != facet_hit(two.tracer().closest(rays[k])).facet ? 1 : 0;
        differ += pierced[k] != two.tracer().count(rays[k]) ? 1 : 0;
        stopped += hits[k].facet == none && blocked[k] != 0 ? 1 : 0; // panes do not block
    }
    CHECK(differ == 0);
    CHECK(stopped > 50);
}

TEST_CASE("A room with a pane is no convex enclosure") {
    CHECK(find_needs(Model(test::furnace_box(1, .5), {}).mesh).closed);
    const Needs needs = find_needs(
        Model(test::furnace_box(1, .5), {pane({.5, 0, 0}, {0, 1, 0}, {0, 0, 1}, .5)}).mesh);
    CHECK_FALSE(needs.closed);
    CHECK(needs.visibility);
}

TEST_CASE("All methods: plates on both sides of a pane exchange its share", "[slow]") {
    // B_0 = 1 + rho F B_1 and B_1 = rho F B_0, with the factor times what passes.
    constexpr double rho = .8, passed = .7 * .9;
    const Model model(two_plates(rho), {between_plates(.3, .7), between_plates(.6, .9)});
    const double k = rho * passed * test::opposed_rectangles(1, 1);
    for (const Run& run : all_runs()) {
        CAPTURE(run.method->name, run.factors);
        const Solution s = solve(model, run, .002);
        CHECK(s.radiosity[0].r == Approx(1 / (1 - k * k)).epsilon(.003));
        CHECK(s.radiosity[1].r == Approx(k / (1 - k * k)).epsilon(.01));
        CHECK(s.energy.emitted.r == Approx(s.energy.absorbed.r + s.energy.escaped.r).epsilon(.01));
    }
}

TEST_CASE("All methods: a room behind two panes, one of them aslant", "[slow]") {
    Scene scene = test::box_room({0, 0, 0}, {2, 1, 1}, 2,
                                 {{"wall", Vec3(.6), Vec3(0)}, {"lamp", Vec3(.3), Vec3(1)}},
                                 {0, 0, 1, 0, 0, 0});
    const std::vector<Pane> panes{pane({.8, 0, 0}, {0, .7, 0}, {0, 0, 1}, .4),
                                  pane({1.1, 0, 0}, {.4, 1, 0}, {0, 0, 1}, .8)};
    const Model model(std::move(scene), panes);
    const std::vector<double> exact = by_brute_force(model.mesh, panes, 40'000);
    for (const Run& run : all_runs()) {
        CAPTURE(run.method->name, run.factors);
        const Solution s = solve(model, run, .01);
        double off = 0, all = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const double reflected = exact[i] - model.mesh.material(std::uint32_t(i)).emission.r;
            off += std::pow(s.radiosity[i].r - exact[i], 2);
            all += reflected * reflected;
        }
        CHECK(std::sqrt(off / all) < .025);
    }
}

TEST_CASE("A lamp without extent shines through a pane by exactly its share") {
    Scene scene = two_plates(.5);
    scene.materials[0].emission = Vec3(0);
    scene.materials[1].reflectance = Vec3(0);
    add_point_emitter(scene, {.name = "p", .position = {.5, .5, .9}, .intensity = Vec3(1)});
    const auto light = [&](const std::vector<Pane>& panes) {
        const Model model(scene, panes);
        return solve(model, {find_method("stored-transport"), ""}, .01).radiosity[0].r;
    };
    CHECK(light({between_plates(.5, .7)}) == Approx(.7 * light({})));
}
