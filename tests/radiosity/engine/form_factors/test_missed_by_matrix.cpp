// What `matrix` reports of light that none of its rays has met.
#include "radiosity/paper/solution/missed_light.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"
#include "support/targets.h"

using namespace hemilux;
using test::Model;

TEST_CASE("A dark room that no ray has left is not known to be dark") {
    Scene scene = test::two_rooms();
    for (Facet& facet : scene.facets) // the lamp of the second room goes out
        if (scene.materials[facet.material].name == "faint")
            facet.material = 0;
    const Model model(scene);
    const std::size_t n = model.mesh.patches().size();
    const auto largest = [&](double rays) {
        const Solution s =
            test::solve(model, *find_method("matrix"), {.rays = rays}, test::steps(1));
        double sigma = 0;
        for (std::size_t i = n / 2; i < n; ++i) {
            CHECK(s.radiosity[i] == Vec3(0.0));
            CHECK(s.standard_error[i].x > 0);
            sigma = std::max(sigma, s.standard_error[i].x);
        }
        return sigma;
    };
    const double few = largest(16), many = largest(256);
    // What leaves most is the lamp, of 1.2 or so; 16 patches a face, 4 batches of rays or more.
    CHECK(few < .5 * 2 * rule_of_three / 16);
    CHECK(many == Approx(few / 16).epsilon(.05));
}

TEST_CASE("Light that three rays might have lost counts in the reported error") {
    const Model model(test::furnace_box(2, .5)); // nobody says that it is closed
    Solution s = test::solve(model, *find_method("matrix"), {.rays = 16}, test::steps(1));
    CHECK(s.missed > 0);
    const double with = estimated_error(model.mesh, s);
    const double missed = s.missed;
    // B = 2 of E = 1: a share of 3 rays by 2 on all of the reflected light.
    const double rays = double(s.hits[0]) * double(s.radiosity.size()); // by patch all alike
    const double level = rule_of_three * 2 / rays * 1;
    double area = 0;
    for (const Patch& patch : model.mesh.patches())
        area += patch.area;
    CHECK(missed == Approx(3 * area * level * level).epsilon(.02));
    s.missed = 0;
    CHECK(estimated_error(model.mesh, s) < with);
}
