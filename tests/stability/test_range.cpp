// Scenes in which one thing is far larger, brighter, thinner or nearer than another, or in which
// faces lie where no real surface could: each against the same scene without the oddity, against a
// closed form, or against the balance of energy.
#include "radiosity/engine/form_factors/factor_options.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/solving/one_shot.h"
#include "radiosity/engine/solving/own_options.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>

using namespace hemilux;
using test::add_quad;
using Model = test::LayeredModel;

namespace {

enum : std::uint32_t { wall, lit, dark };

/// A closed box from `low` to `high`, n x n quads a side; sides in the order of box_room.
Scene box(const Vec3& low, const Vec3& high, std::uint32_t n,
          const std::array<std::uint32_t, 6>& material, double glow = 1) {
    return test::box_room(low, high, n,
                          {{"wall", Vec3(.5), Vec3(0.0)},
                           {"lit", Vec3(.5), Vec3(glow)},
                           {"dark", Vec3(0.0), Vec3(0.0)}},
                          material);
}

Scene cube(std::uint32_t n, double glow = 1) {
    return box(Vec3(0.0), Vec3(1.0), n, {lit, wall, wall, wall, wall, wall}, glow);
}

/// The facets of another scene with the same materials.
void add(Scene& scene, const Scene& other) {
    const auto base = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Facet facet : other.facets) {
        for (std::uint32_t& v : facet.vertex)
            v += base;
        facet.face = scene.faces++;
        scene.facets.push_back(facet);
    }
}

/// The outside of a box: fronts outward.
Scene solid(const Vec3& low, const Vec3& high, std::uint32_t n, std::uint32_t material) {
    Scene scene = box(low, high, n, {material, material, material, material, material, material});
    for (Facet& facet : scene.facets)
        std::swap(facet.vertex[1], facet.vertex[3]);
    return scene;
}

Solution solved(const Model& model, const Method& method, double rays = 64) {
    SolveOptions options;
    options.rays = rays;
    options.threads = 1;
    const bool one_shot = method.name == "progressive"; // until the first pass has ended
    set_own_options(options, OneShotOptions{.one_shot = one_shot});
    const Needs needs = find_needs(model.mesh);
    Monitor monitor;
    const SolverInput input{model.mesh, model.bvh, options, monitor, needs};
    const auto solver = method.make(input);
    run(*solver, input, test::steps(one_shot ? 1'000'000 : 4));
    const Solution& s = solver->solution();
    for (const Vec3& b : s.radiosity)
        REQUIRE(std::isfinite(b.x + b.y + b.z));
    return s;
}

Solution exact(const Model& model) {
    SolveOptions options;
    set_own_options(options, FactorOptions{.kind = FactorKind::exact});
    return test::solve(model, *find_method("matrix"), options, test::steps(2));
}

/// Area-weighted mean radiosity (red) of the patches from `begin` to `end`.
double mean(const Model& model, const Solution& s, std::size_t begin, std::size_t end) {
    double sum = 0, area = 0;
    for (std::size_t i = begin; i < end; ++i) {
        sum += model.mesh.patches()[i].area * s.radiosity[i].x;
        area += model.mesh.patches()[i].area;
    }
    return sum / area;
}

/// Of the radiosity that these patches reflect; both solutions have them first.
double relative_error(const Model& model, const Solution& s, const Solution& right,
                      std::size_t patches) {
    double error = 0, value = 0;
    for (std::uint32_t i = 0; i < patches; ++i) {
        const double area = model.mesh.patches()[i].area;
        const double off = s.radiosity[i].x - right.radiosity[i].x;
        const double reflected = right.radiosity[i].x - model.mesh.material(i).emission.x;
        error += area * off * off;
        value += area * reflected * reflected;
    }
    return std::sqrt(error / value);
}

bool stores_transport(const Method& method) {
    return method.name == "stored-transport" || method.name == "matrix";
}

/// What four steps of 64 rays make of the rooms below, with room to spare.
double noise(const Method& method) { return stores_transport(method) ? .03 : .15; }

/// Nothing leaves a closed scene.
void check_balance(const Solution& s) {
    CHECK(s.energy.escaped.x == 0);
    CHECK(s.energy.imbalance() < 1e-10);
    CHECK(std::abs(s.energy.unshot.x) < .05 * s.energy.emitted.x);
}

template <class Check>
void by_all_methods(const Check& check) {
    for (const Method* const method : methods()) {
        CAPTURE(method->name);
        check(*method);
    }
}

} // namespace

TEST_CASE("Emission of about 1e-30 and of 1e30 is emission of 1 in other units") {
    const Model one(cube(2)), faint(cube(2, 0x1p-100)), bright(cube(2, 0x1p100));
    by_all_methods([&](const Method& method) {
        const Solution a = solved(one, method, 32), b = solved(faint, method, 32),
                       c = solved(bright, method, 32);
        for (std::size_t i = 0; i < a.radiosity.size(); ++i) {
            CHECK(b.radiosity[i].x == 0x1p-100 * a.radiosity[i].x);
            CHECK(c.radiosity[i].x == 0x1p100 * a.radiosity[i].x);
        }
        CHECK(b.energy.absorbed.x == 0x1p-100 * a.energy.absorbed.x);
        CHECK(estimated_error(bright.mesh, c) == estimated_error(one.mesh, a));
    });
}

TEST_CASE("Lamps of 1e30 and 1e-30 in one room: the bright one's solution") {
    Scene scene = cube(3, 1e30);
    scene.materials.push_back({"faint", Vec3(.5), Vec3(1e-30)});
    const Model alone(scene);
    for (std::size_t f = 9; f < 18; ++f) // the ceiling
        scene.facets[f].material = 3;
    const Model both(scene);
    by_all_methods([&](const Method& method) {
        const Solution a = solved(alone, method), b = solved(both, method);
        CHECK(relative_error(both, b, a, 54) < noise(method));
        check_balance(b);
    });
}

TEST_CASE("A faint room beside a bright one is solved too where transport is stored") {
    Scene scene = box(Vec3(0.0), Vec3(1.0), 2, {lit, lit, lit, lit, lit, lit}, 1e30);
    scene.materials.push_back({"faint", Vec3(.5), Vec3(1e-30)});
    add(scene, box(Vec3(2, 0, 0), Vec3(3, 1, 1), 2, {3, 3, 3, 3, 3, 3}));
    const Model model(scene);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method);
        CHECK(mean(model, s, 0, 24) == Approx(2e30).epsilon(noise(method)));
        if (stores_transport(method))
            for (std::size_t i = 24; i < 48; ++i)
                CHECK(s.radiosity[i].x == Approx(2e-30).epsilon(.02));
        else // not one ray is due to a light of 1e-60 of the other
            CHECK((mean(model, s, 24, 48) >= .999e-30 && mean(model, s, 24, 48) < 2.2e-30));
    });
}

TEST_CASE("A lamp of 1e-12 of a wall lights the room as its power says", "[slow]") {
    // The same power from a lamp a millionth as wide: beyond its own size nobody can tell.
    const auto room = [](double half) {
        Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, wall, wall, wall, wall, wall},
                          1 / (4 * half * half));
        add_quad(scene, {.5 - half, .9, .5 - half}, {.5 + half, .9, .5 - half},
                 {.5 + half, .9, .5 + half}, {.5 - half, .9, .5 + half}, 1, 1, lit);
        return scene;
    };
    const Model small(room(5e-7)), large(room(5e-3));
    CHECK(small.mesh.patches()[0].area / small.mesh.patches()[54].area == Approx(1e12 / 9));
    const Solution right = exact(large);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(small, method);
        CHECK(relative_error(large, s, right, 54) < noise(method));
        CHECK(s.energy.absorbed.x == Approx(1).epsilon(.05));
    });
}

TEST_CASE("A receiver of 1e-12 of a wall is as bright as the floor on which it lies", "[slow]") {
    Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, lit, wall, wall, wall, wall});
    add_quad(scene, {.5, 1e-6, .5}, {.5, 1e-6, .500001}, {.500001, 1e-6, .500001},
             {.500001, 1e-6, .5}, 1, 1, wall);
    const Model model(scene),
        without(box(Vec3(0.0), Vec3(1.0), 3, {wall, lit, wall, wall, wall, wall}));
    const Solution right = exact(without);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method, 512);
        CHECK(relative_error(without, s, right, 54) < noise(method));
        check_balance(s);
        if (stores_transport(method)) // few rays of others ever meet it
            CHECK(s.radiosity[54].x == Approx(right.radiosity[4].x).epsilon(.15));
    });
}

TEST_CASE("Triangles a million times as long as wide are a part of their wall", "[slow]") {
    // Ten of them along an edge of the floor, in place of a strip of it.
    const auto room = [](bool slivers) {
        Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, wall, wall, wall, wall, wall});
        for (std::size_t f = 9; f < 18; ++f)
            scene.facets[f].material = lit; // the ceiling
        scene.facets.erase(scene.facets.begin(), scene.facets.begin() + 9);
        const double width = slivers ? 1e-6 : 0;
        for (int k = 0; k < (slivers ? 5 : 0); ++k) {
            const auto v = static_cast<std::uint32_t>(scene.vertices.size());
            const double x = k * width;
            scene.vertices.insert(scene.vertices.end(),
                                  {{x, 0, 0}, {x, 0, 1}, {x + width, 0, 1}, {x + width, 0, 0}});
            scene.facets.push_back({{v, v + 1, v + 2, v + 2}, scene.faces++, wall, 0});
            scene.facets.push_back({{v, v + 2, v + 3, v + 3}, scene.faces++, wall, 0});
        }
        const double x = 5 * width;
        add_quad(scene, {x, 0, 0}, {x, 0, 1}, {1, 0, 1}, {1, 0, 0}, 3, 3, wall);
        return scene;
    };
    const Model with(room(true)), without(room(false));
    const Solution right = exact(without);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(with, method);
        CHECK(relative_error(without, s, right, 45) < noise(method));
        check_balance(s);
        if (method.name == "stored-transport") // a sliver has the light of the foot of the wall
            CHECK(mean(with, s, 45, 55) == Approx(right.radiosity[46].x).epsilon(.2));
    });
}

TEST_CASE("Walls a millionth of the room apart: two endless plates") {
    Scene scene = box(Vec3(0.0), Vec3(1.0), 1, {dark, dark, dark, dark, dark, dark});
    add_quad(scene, {.2, .5, .2}, {.2, .5, .8}, {.8, .5, .8}, {.8, .5, .2}, 3, 3, lit);
    add_quad(scene, {.2, .500001, .2}, {.8, .500001, .2}, {.8, .500001, .8}, {.2, .500001, .8}, 3,
             3, wall);
    const Model model(scene);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method);
        const double tolerance = stores_transport(method) ? .01 : .05;
        CHECK(mean(model, s, 6, 15) == Approx(1 / (1 - .25)).epsilon(tolerance));
        CHECK(mean(model, s, 15, 24) == Approx(.5 / (1 - .25)).epsilon(tolerance));
        CHECK(mean(model, s, 0, 6) < 1e-4);
    });
}

TEST_CASE("A wall with a face for each side, at a distance or in one place, divides two rooms",
          "[slow]") {
    for (const auto& [gap, divisions] : {std::pair{1e-6, 4u}, {0.0, 4u}, {0.0, 3u}})
        for (const bool far_side_first : {false, true}) {
            Scene scene = box(Vec3(0.0), Vec3(1.0), 4, {wall, wall, lit, wall, wall, wall});
            const double a = .5 - gap / 2, b = .5 + gap / 2;
            for (const bool far : {far_side_first, !far_side_first})
                far ? add_quad(scene, {b, 0, 0}, {b, 1, 0}, {b, 1, 1}, {b, 0, 1}, divisions,
                               divisions, wall)
                    : add_quad(scene, {a, 0, 0}, {a, 0, 1}, {a, 1, 1}, {a, 1, 0}, 4, 4, wall);
            const Model model(scene);
            const std::size_t of_far = divisions * divisions;
            const std::size_t near = far_side_first ? 96 + of_far : 96;
            const std::size_t far = far_side_first ? 96 : 112;
            CAPTURE(gap, divisions, far_side_first);
            by_all_methods([&](const Method& method) {
                const Solution s = solved(model, method);
                CHECK(mean(model, s, near, near + 16) == Approx(.3146).epsilon(.05));
                CHECK(mean(model, s, far, far + of_far) == 0);
                CHECK(mean(model, s, 48, 64) == 0); // the wall beyond
                check_balance(s);
            });
        }
}

TEST_CASE("Faces that are there twice change nothing") {
    const Scene once = cube(3);
    Scene twice = once;
    for (std::size_t f = 0; f < 27; ++f) { // the lit floor, the ceiling and a wall
        Facet facet = once.facets[f];
        std::rotate(facet.vertex.begin(), facet.vertex.begin() + f % 4, facet.vertex.end());
        twice.facets.push_back(facet);
    }
    const Model right_model(once), model(twice);
    const Solution right = exact(right_model);
    CHECK(relative_error(right_model, exact(model), right, 54) < .02);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method);
        CHECK(relative_error(right_model, s, right, 54) < noise(method));
        check_balance(s);
        for (std::size_t i = 63; i < 81; ++i)
            CHECK(s.radiosity[i].x == 0); // beneath its double
    });
}

TEST_CASE("A lamp in the very plane of the ceiling shines as one just below", "[slow]") {
    // Over all nine quads of the ceiling, or beside four of them on the one in the middle.
    for (const double half : {.2, .1}) {
        const auto room = [&](double y) {
            Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, wall, wall, wall, wall, wall}, 10);
            add_quad(scene, {.5 - half, y, .5 - half}, {.5 + half, y, .5 - half},
                     {.5 + half, y, .5 + half}, {.5 - half, y, .5 + half}, 1, 1, lit);
            return scene;
        };
        const Model within(room(1)), below(room(1 - 1e-6));
        const Solution right = test::reference(below, .005);
        CHECK(relative_error(below, test::reference(within, .005), right, 55) < .01);
        by_all_methods([&](const Method& method) {
            const Solution s = solved(within, method, 256);
            CHECK(relative_error(below, s, right, 55) < noise(method));
            check_balance(s);
        });
    }
}

TEST_CASE("Two floors that overlap in part: the first is seen", "[slow]") {
    // The second one, black, reaches beyond the room's first one of half its width.
    const auto room = [](double overlap) {
        Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, lit, wall, wall, wall, wall});
        scene.facets.erase(scene.facets.begin(), scene.facets.begin() + 9);
        add_quad(scene, {0, 0, 0}, {0, 0, 1}, {.5, 0, 1}, {.5, 0, 0}, 1, 1, wall);
        add_quad(scene, {.5 - overlap, 0, 0}, {.5 - overlap, 0, 1}, {1 - overlap, 0, 1},
                 {1 - overlap, 0, 0}, 1, 1, dark);
        add_quad(scene, {1 - overlap, 0, 0}, {1 - overlap, 0, 1}, {1, 0, 1}, {1, 0, 0}, 1, 1, dark);
        return scene;
    };
    const Model with(room(.2)), without(room(0x1p-30));
    const Solution right = test::reference(without, .005);
    CHECK(relative_error(without, test::reference(with, .005), right, 47) < .01);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(with, method, 256);
        CHECK(relative_error(without, s, right, 47) < noise(method));
        check_balance(s);
    });
}

TEST_CASE("Solids that reach into each other", "[slow]") {
    Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, lit, wall, wall, wall, wall});
    add(scene, solid({.2, .1, .2}, {.6, .5, .6}, 2, wall));
    add(scene, solid({.4, .2, .4}, {.8, .7, .8}, 2, wall));
    add(scene, solid({.45, .3, .45}, {.5, .4, .5}, 1, wall)); // within both
    const Model model(scene);
    const Solution right = test::reference(model, .005);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method, 256);
        CHECK(relative_error(model, s, right, 108) < noise(method));
        check_balance(s);
        CHECK(mean(model, s, 102, 108) == 0);
    });
}

TEST_CASE("A light in a closed box stays there", "[slow]") {
    Scene scene = box(Vec3(0.0), Vec3(1.0), 3, {wall, wall, wall, wall, wall, wall});
    add(scene, solid(Vec3(.3), Vec3(.6), 2, wall));
    add(scene, box(Vec3(.3), Vec3(.6), 2, {lit, lit, lit, lit, lit, lit})); // in one place with it
    const Model model(scene);
    by_all_methods([&](const Method& method) {
        const Solution s = solved(model, method);
        CHECK(mean(model, s, 0, 78) == 0);
        CHECK(mean(model, s, 78, 102) == Approx(2).epsilon(stores_transport(method) ? 1e-6 : .02));
        check_balance(s);
    });
}
