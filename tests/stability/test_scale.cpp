// One room in any unit and anywhere: the same solution, as long as doubles tell its corners apart.
#include "bvh/wide/wide_bvh.h"
#include "radiosity/engine/needs/find_needs.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;

namespace {

/// Oblique to all axes, so that no coordinate is exact; with furniture, so that rays are stopped.
Scene oblique_room() {
    Scene scene = test::room_with_block();
    const Frame frame = Frame::from_normal(glm::normalize(Vec3(.3, .5, .8))).turned(.7);
    for (Vec3& v : scene.vertices)
        v = frame.to_world(v);
    return scene;
}

Scene placed(Scene scene, double unit, const Vec3& shift) {
    for (Vec3& v : scene.vertices)
        v = unit * v + shift;
    return scene;
}

/// As the program does it: with the fast tracer, and without what the scene does not need.
Solution solved(const Scene& scene, const Method& method, double rays = 24) {
    const Mesh mesh(scene);
    const WideBvh bvh(mesh.soup());
    const Needs needs = find_needs(mesh);
    SolveOptions options;
    options.rays = rays;
    options.threads = 1;
    Monitor monitor;
    const SolverInput input{mesh, bvh, options, monitor, needs};
    const auto solver = method.make(input);
    run(*solver, input, test::steps(2));
    return solver->solution();
}

/// The largest relative difference of a patch in a channel.
double difference(const Solution& a, const Solution& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.radiosity.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = a.radiosity[i][c], y = b.radiosity[i][c];
            const double off = x == y ? 0 : std::abs(x - y) / std::max(std::abs(x), std::abs(y));
            if (!(off <= largest)) // NaN
                largest = off;
        }
    return largest;
}

/// How far apart two solutions are beside what they say of their errors, both as RMS over patches.
double error_in_its_own_measure(const Solution& a, const Solution& b) {
    const auto squared = [](const Vec3& v) { return glm::dot(v, v); };
    double off = 0, expected = 0;
    for (std::size_t i = 0; i < a.radiosity.size(); ++i) {
        off += squared(a.radiosity[i] - b.radiosity[i]);
        expected += squared(a.standard_error[i]) + squared(b.standard_error[i]);
    }
    return std::sqrt(off / expected);
}

/// A cube of 1 m with a lit floor, and in its middle a tiny box that is open at one side.
Scene with_tiny_box(double size) {
    Scene scene = test::cube_with_lit_floor(2, .5);
    Scene box = test::box_room(Vec3(.5 - size / 2), Vec3(.5 + size / 2), 1,
                               {{"tiny", Vec3(.7, .5, .3)}}, {0, 0, 0, 0, 0, 0});
    box.facets.erase(box.facets.begin());
    test::add_scene(scene, box);
    return scene;
}

constexpr double room_size = 4.7; ///< the diagonal

/// `progressive` asks its estimates whether they agree, and goes on if they do not: there a
/// rounding error can decide about other rays.
bool same_rays_everywhere(const Method& method) { return method.name != "progressive"; }

} // namespace

TEST_CASE("The unit of length changes no radiosity", "[slow]") {
    const Scene room = oblique_room();
    for (const Method* const method : methods()) {
        if (!same_rays_everywhere(*method))
            continue;
        const Solution metres = solved(room, *method);
        for (const double unit : {1e-12, 1e3, 1e12}) {
            const Solution s = solved(placed(room, unit, Vec3(0.0)), *method);
            CAPTURE(method->name, unit);
            CHECK(difference(s, metres) < 1e-5);
            for (const auto& [power, before] : {std::pair{s.energy.emitted, metres.energy.emitted},
                                                {s.energy.absorbed, metres.energy.absorbed}})
                CHECK(power.x == Approx(unit * unit * before.x).epsilon(1e-6));
        }
    }
}

TEST_CASE("Nor does the place, as far as doubles carry it", "[slow]") {
    const Scene room = oblique_room();
    for (const Method* const method : methods()) {
        if (!same_rays_everywhere(*method))
            continue;
        const Solution here = solved(room, *method);
        for (const double sizes : {1e3, 1e6, 1e8}) {
            const Vec3 shift = sizes * room_size * Vec3(.7, -1, .4);
            const Scene there = placed(room, 1, shift);
            const Solution s = solved(there, *method);
            CAPTURE(method->name, sizes);
            CHECK(difference(s, here) < 1e-5);
            // Of the rounding that is left all is the input's own.
            if (sizes == 1e8)
                CHECK(difference(s, solved(placed(there, 1, -shift), *method)) < 1e-12);
        }
    }
}

TEST_CASE("Far away and in other units the methods of other rays are right within their errors") {
    const Scene room = oblique_room();
    for (const Method* const method : methods()) {
        if (same_rays_everywhere(*method))
            continue;
        const Solution here = solved(room, *method);
        for (const double unit : {1e-12, 1.0, 1e12}) {
            const Vec3 shift = unit * 1e8 * room_size * Vec3(.7, -1, .4);
            const Solution s = solved(placed(room, unit, shift), *method);
            CAPTURE(method->name, unit);
            CHECK(error_in_its_own_measure(s, here) < 1.5);
        }
    }
}

TEST_CASE("A thing has the same light however small it is beside the room") {
    for (const Method* const method : methods()) {
        const Solution small = solved(with_tiny_box(1e-3), *method, 1000);
        for (const double size : {1e-6, 1e-10}) {
            const Solution tiny = solved(with_tiny_box(size), *method, 1000);
            CAPTURE(method->name, size);
            CHECK(error_in_its_own_measure(tiny, small) < 1.5);
        }
    }
}
