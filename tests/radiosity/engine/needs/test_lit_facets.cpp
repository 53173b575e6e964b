// Light that is found not to reach a side never gets there.
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"

#include <algorithm>

using namespace hemilux;

namespace {

constexpr std::uint32_t white = 0, lamp = 1;

Scene nothing() {
    Scene scene;
    scene.materials = {{"white", Vec3(.7), Vec3(0.0)}, {"lamp", Vec3(.7), Vec3(1.0)}};
    scene.groups = {"default"};
    return scene;
}

void append(Scene& scene, const Scene& other) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Facet facet : other.facets) {
        for (std::uint32_t& v : facet.vertex)
            v += first;
        scene.facets.push_back(facet);
    }
}

/// Adds a room of n x n facets a side; material[side] as for box_room.
void add_room(Scene& scene, const Vec3& low, const Vec3& high, std::uint32_t n = 1,
              const std::array<std::uint32_t, 6>& materials = {}) {
    append(scene, test::box_room(low, high, n, scene.materials, materials));
}

/// Boxes seen from inside or from outside, some with a side missing, some with a shining one, and
/// sheets. On a grid many touch each other, share edges or lie over each other; on one that is
/// turned they do so but for rounding.
enum class Places { anywhere, on_grid, on_turned_grid };

Scene random_boxes(std::uint64_t seed, Places places) {
    const bool on_grid = places != Places::anywhere;
    Rng rng(seed);
    Scene scene = nothing();
    const auto number = [&](unsigned n) { return static_cast<unsigned>(rng.uniform() * n); };
    const auto point = [&] {
        const Vec3 p(rng.uniform(), rng.uniform(), rng.uniform());
        return on_grid ? glm::floor(5.0 * p) : 5.0 * p;
    };
    const unsigned boxes = 2 + number(6);
    for (unsigned k = 0; k < boxes; ++k) {
        const Vec3 p = point(), q = point();
        const Vec3 low = glm::min(p, q), high = glm::max(glm::max(p, q), low + (on_grid ? 1. : .1));
        std::array<std::uint32_t, 6> materials{};
        if (k == 0 || number(4) == 0)
            materials[number(6)] = lamp;
        Scene box = nothing();
        add_room(box, low, high, 1 + number(2), materials);
        if (number(3) == 0)
            for (Facet& facet : box.facets)
                std::reverse(facet.vertex.begin(), facet.vertex.end());
        if (number(4) == 0)
            box.facets.resize(1 + number(static_cast<unsigned>(box.facets.size())));
        append(scene, box);
    }
    if (places == Places::on_turned_grid)
        for (Vec3& v : scene.vertices) {
            v = Vec3(.8 * v.x - .6 * v.y, .6 * v.x + .8 * v.y, v.z);
            v = Vec3(v.x, .28 * v.y - .96 * v.z, .96 * v.y + .28 * v.z);
        }
    return scene;
}

} // namespace

TEST_CASE("A facet under another of its plane is dark") {
    const auto sheets_in_room = [](double width) {
        Scene scene = nothing();
        add_room(scene, Vec3(0.0), Vec3(4.0), 1, {white, lamp, white, white, white, white});
        for (const double w : {width, 2.0})
            test::add_quad(scene, {1, 1, 1}, {1, 1, 1 + w}, {1 + w, 1, 1 + w}, {1 + w, 1, 1}, 1, 1,
                           white);
        return find_lit_patches(layered_mesh(std::move(scene), {}));
    };
    const std::vector<bool> twins = sheets_in_room(2), on_larger = sheets_in_room(1);
    CHECK(twins[6] != twins[7]);
    CHECK(on_larger[6]);
    CHECK(on_larger[7]);
}

TEST_CASE("Where it is taken that no light comes no ray ever does", "[slow]") {
    const Places places = GENERATE(Places::anywhere, Places::on_grid, Places::on_turned_grid);
    const bool two_sided = GENERATE(false, true);
    CAPTURE(static_cast<int>(places), two_sided);
    SolveOptions options;
    options.rays = 400;
    std::size_t dark = 0, without_hits = 0, wrong = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const test::LayeredModel model(random_boxes(seed, places), {.two_sided = two_sided});
        const std::vector<bool> lit = find_lit_patches(model.mesh);
        options.seed = seed;
        const Solution solution =
            test::solve(model, *find_method("stratified"), options, test::steps(1));
        for (std::size_t i = 0; i < lit.size(); ++i) {
            dark += !lit[i];
            without_hits += solution.hits[i] == 0;
            wrong += !lit[i] && solution.hits[i] > 0;
            if (!lit[i] && solution.hits[i] > 0)
                UNSCOPED_INFO("seed " << seed << ", patch " << i);
        }
    }
    CAPTURE(dark, without_hits);
    CHECK(wrong == 0);
    CHECK(dark > without_hits / 4);
}
