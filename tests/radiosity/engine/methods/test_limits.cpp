// What a small file or a large option may cost: counted, or ended by the time of the run.
#include "radiosity/engine/solving/time_limit.h"
#include "radiosity/light/layers/coplanar_layers.h"
#include "radiosity/light/layers/coplanar_overlaps.h"
#include "radiosity/paper/sampling/rng.h"
#include "radiosity/paper/scene/mesh.h"
#include "support/watched_tracer.h"

#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <sys/resource.h>
#include <thread>

using namespace hemilux;
using test::Model;

namespace {

enum : std::uint32_t { grey, bright };

Scene empty_scene() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0.0)}, {"bright", Vec3(.5), Vec3(1.0)}};
    scene.groups = {"default"};
    return scene;
}

/// A lamp over n triangles in one place. Each begins at another corner, and every third faces down.
Scene pile(std::uint32_t n) {
    Scene scene = empty_scene();
    test::add_quad(scene, {0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}, 1, 1, bright);
    const auto v = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    for (std::uint32_t k = 0; k < n; ++k) {
        std::array<std::uint32_t, 3> c{v + k % 3, v + (k + 1) % 3, v + (k + 2) % 3};
        if (k % 3 == 2)
            std::swap(c[0], c[1]);
        scene.facets.push_back({{c[0], c[1], c[2], c[2]}, scene.faces++, grey, 0});
    }
    return scene;
}

/// The same with corners of their own, each moved along each axis by up to so much.
Scene scattered_pile(std::uint32_t n, double by) {
    Scene scene = pile(n);
    Rng rng(3);
    for (Facet& facet : std::span(scene.facets).subspan(1)) {
        for (std::size_t i = 0; i < 3; ++i) {
            scene.vertices.push_back(
                scene.vertices[facet.vertex[i]] +
                by * (2.0 * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0));
            facet.vertex[i] = static_cast<std::uint32_t>(scene.vertices.size() - 1);
        }
        facet.vertex[3] = facet.vertex[2];
    }
    return scene;
}

/// Squares of one plane each of which lies over every other, no two in the same place.
Scene heap(std::uint32_t n) {
    Scene scene = empty_scene();
    Rng rng(7);
    for (std::uint32_t k = 0; k < n; ++k) {
        const double x = .01 * rng.uniform(), y = .01 * rng.uniform();
        test::add_quad(scene, {x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}, 1, 1,
                       bright);
    }
    return scene;
}

std::vector<Vec3> local(const Scene& scene) {
    return LocalFrame::of(scene).to_local(scene.vertices);
}

std::size_t facets_out_of_reach(const Mesh& mesh) {
    return static_cast<std::size_t>(
        std::ranges::count_if(mesh.soup_to_trace().facets,
                              [](const FacetCorners& c) { return c[0] == c[1] && c[1] == c[2]; }));
}

/// How many facets unite_near_twins() changes.
std::size_t united(const Scene& scene) {
    Scene after = scene;
    unite_near_twins(after, local(scene));
    std::size_t changed = 0;
    for (std::size_t f = 0; f < scene.facets.size(); ++f)
        changed += after.facets[f].vertex != scene.facets[f].vertex;
    return changed;
}

/// Sanitizers have memory of their own, so their builds do not ask.
[[maybe_unused]] double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Does something when so many shadow rays have been traced.
class AfterShadowRays final : public test::WatchedTracer {
  public:
    AfterShadowRays(const Tracer& tracer, int rays, std::function<void()> what)
        : WatchedTracer(tracer, [](std::span<const Ray>) {}), left_(rays), what_(std::move(what)) {}
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        if (--left_ == 0)
            what_();
        return WatchedTracer::occluded(ray, target);
    }

  private:
    mutable std::atomic<int> left_;
    std::function<void()> what_;
};

} // namespace

TEST_CASE("Facets in one place make no more pairs than the few that are kept") {
    const Scene scene = pile(30'000);
    const Overlaps overlaps = find_overlaps(scene, local(scene));
    CHECK(overlaps.complete);
    CHECK(overlaps.buried.size() == 30'000 - 2 * kept_alike);
    CHECK(overlaps.pairs.size() == kept_alike * (2 * kept_alike - 1));
    CHECK(find_coplanar_layers(scene, local(scene)).covered == 30'000 - 2);
    const Mesh mesh(scene);
    CHECK(mesh.all_layers_are_offset());
    CHECK(mesh.patches().size() == 30'001);
    CHECK(facets_out_of_reach(mesh) == 30'000 - 2 * kept_alike);
}

TEST_CASE("Facets that are in one place but for rounding are as if they were in it exactly") {
    constexpr double by = 1e-7;
    const Scene scene = scattered_pile(3000, by);
    const Mesh mesh(scene);
    CHECK(mesh.all_layers_are_offset());
    CHECK(facets_out_of_reach(mesh) >= 3000 - 8 * kept_alike);
    double farthest = 0;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            farthest =
                std::max(farthest, glm::length(scene.vertices[mesh.scene().facets[f].vertex[i]] -
                                               scene.vertices[scene.facets[f].vertex[i]]));
    CHECK(farthest > 0);
    CHECK(farthest < 4 * by);
}

TEST_CASE("Few facets near each other, and many that lie beside each other, stay where they are") {
    CHECK(united(scattered_pile(kept_alike, 1e-7)) == 0);
    CHECK(united(scattered_pile(3000, 1e-2)) == 0);
    CHECK(united(scattered_pile(3000, 1e-7)) > 2800);
    Scene strip = empty_scene();
    test::add_quad(strip, {0, 0, 0}, {1e-3, 0, 0}, {1e-3, 1, 0}, {0, 1, 0}, 2000, 1, grey);
    test::add_quad(strip, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 1, 1, grey);
    CHECK(united(strip) == 0);
}

TEST_CASE("Of many facets in one place the first is lit as if it were alone", "[slow]") {
    const Method& method = *find_method("monte-carlo");
    const auto solved = [&](std::uint32_t n) {
        const Model model(pile(n));
        const SolveOptions options{.rays = 40'000.0 / (n + 1), .threads = 1};
        return test::solve(model, method, options, test::steps(16)).radiosity[1].x;
    };
    const double few = solved(3);
    CHECK(few > 0);
    CHECK(solved(100) == Approx(few).epsilon(.05));
    Scene one_way = scattered_pile(100, 1e-7);
    for (std::size_t f = 3; f < one_way.facets.size(); f += 3)
        std::swap(one_way.facets[f].vertex[0], one_way.facets[f].vertex[1]);
    const Model scattered(one_way);
    const SolveOptions options{.rays = 40'000.0 / 101, .threads = 1};
    const Solution solution = test::solve(scattered, method, options, test::steps(16));
    CHECK(solution.radiosity[1].x == Approx(few).epsilon(.05));
}

TEST_CASE("The brightest of many facets in one place is never buried") {
    Scene scene = pile(300);
    scene.facets[200].material = bright;
    const std::vector<Buried> buried = find_overlaps(scene, local(scene)).buried;
    CHECK(buried.size() == 300 - 2 * kept_alike);
    CHECK(std::ranges::none_of(buried, [](const Buried& b) { return b.facet == 200; }));
}

TEST_CASE("Pairs of facets over each other end at their limit, which is reported", "[slow]") {
    const Scene scene = heap(1500);
    const OverlapLimits limits = OverlapLimits::of(scene);
    const Overlaps overlaps = find_overlaps(scene, local(scene));
    CHECK(overlaps.pairs.size() <= limits.pairs);
    CHECK_FALSE(overlaps.complete);
    CHECK_FALSE(Mesh(scene).all_layers_are_offset());
    CHECK(find_overlaps(heap(500), local(heap(500))).complete);
}

TEST_CASE("Rays of a step are listed in parts, however many there are", "[slow]") {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const Model model(test::room_with_block());
    for (const char* name : {"stratified", "hemisphere", "monte-carlo", "hemisphere-1997"})
        for (const bool literal : {false, true}) {
            const Method& method = *find_method(name);
            if (literal && !method.has_literal)
                continue;
            CAPTURE(name, literal);
            Monitor monitor;
            const test::AfterStreams tracer(model.bvh, 400,
                                            [&] { monitor.interrupted.set_wished(true); });
            const SolveOptions options{.rays = 1e9, .literal = literal, .threads = 1};
            const auto solver = method.make({model.mesh, tracer, options, monitor});
            const double before = peak_megabytes();
            CHECK_FALSE(solver->step());
            CHECK(peak_megabytes() - before < 16);
        }
#endif
}

TEST_CASE("At the end of its time every method leaves the step it is in") {
    const Model model(test::room_with_block());
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        Monitor monitor;
        const SolveOptions options{.rays = 4e3, .threads = 2};
        const test::AfterStreams tracer(model.bvh, 100,
                                        [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method->make({model.mesh, tracer, options, monitor});
        const bool counts = solver->step(); // progressive: the shots that were done
        CHECK(solver->solution().steps == (counts ? 1 : 0));
        CHECK_FALSE(monitor.interrupted.is_wished());
        CHECK(monitor.rays < 4000 * model.mesh.patches().size());
    }
}

TEST_CASE("The light of a shot that the time has cut short is still to be shot") {
    const Model model(test::room_with_block());
    const Method& method = *find_method("progressive");
    const SolveOptions options{.rays = 256, .threads = 1};
    const auto rays = double(test::solve(model, method, options, test::steps(1)).rays_energy);
    for (const double share : {.7, .8, .9}) {
        CAPTURE(share);
        Monitor monitor;
        const AfterShadowRays tracer(model.bvh, int(share * rays),
                                     [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method.make({model.mesh, tracer, options, monitor});
        REQUIRE(solver->step());
        const EnergyBalance& energy = solver->solution().energy;
        CHECK(energy.imbalance() < 1e-9);
        CHECK(glm::length(energy.unshot) > 0);
    }
}

TEST_CASE("A run to a time ends within its first step", "[slow]") {
    const Model model(test::room_with_block());
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        Monitor monitor;
        const SolveOptions options{.rays = 1e9, .threads = 2};
        const SolverInput input{model.mesh, model.bvh, options, monitor};
        const auto solver = method->make(input);
        CHECK(run(*solver, input, {.steps = {}, .seconds = .01, .error = {}}));
        CHECK_FALSE(monitor.interrupted);
    }
}

TEST_CASE("A step that the time has cut short is taken anew and gives what it would have given") {
    const Model model(test::room_with_block());
    for (const char* name : {"hemisphere", "monte-carlo", "stored-transport"}) {
        CAPTURE(name);
        const Method& method = *find_method(name);
        const SolveOptions options{.rays = 64, .stop = test::steps(2), .threads = 2};
        const Solution whole = test::solve(model, method, options, test::steps(2));
        Monitor monitor;
        const test::AfterStreams tracer(model.bvh, 3,
                                        [&] { monitor.interrupted.set_out_of_time(true); });
        const auto solver = method.make({model.mesh, tracer, options, monitor});
        while (solver->solution().steps < 2)
            if (!solver->step())
                monitor.interrupted.set_out_of_time(false);
        CHECK(solver->solution().radiosity == whole.radiosity);
    }
}

TEST_CASE("A time limit sets its flag once the time is over, and clears it in the end") {
    StopFlag flag;
    {
        const TimeLimit none(flag, std::nullopt), long_one(flag, 1e300);
        CHECK_FALSE(bool(flag));
    }
    {
        const TimeLimit limit(flag, 0.0);
        while (!flag)
            std::this_thread::yield();
        CHECK(flag.is_out_of_time());
        CHECK_FALSE(flag.is_wished());
    }
    CHECK_FALSE(bool(flag));
}
