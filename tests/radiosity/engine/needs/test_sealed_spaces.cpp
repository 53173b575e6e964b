// What closed surfaces keep apart: light found to be kept out of a space never gets there.
#include "radiosity/engine/needs/closed_surfaces.h"
#include "radiosity/engine/needs/facet_contact.h"
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/engine/needs/sealed_spaces.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"

#include <algorithm>
#include <functional>

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

constexpr std::array<std::uint32_t, 6> lit_from_above{white, lamp, white, white, white, white};

/// A lit room of 6 facets, and what `more` adds to it.
std::vector<bool> lit_beside_room(const std::function<void(Scene&)>& more,
                                  const MeshOptions& options = {}) {
    Scene scene = nothing();
    add_room(scene, Vec3(0.0), Vec3(4.0), 1, lit_from_above);
    more(scene);
    return find_lit_patches(layered_mesh(std::move(scene), options));
}

/// Returns whether all patches from the first on are lit, or none: 1, 0; -1: some.
int lit_from(const std::vector<bool>& lit, std::size_t first) {
    const auto count = std::count(lit.begin() + std::ptrdiff_t(first), lit.end(), true);
    return count == 0 ? 0 : count == std::ptrdiff_t(lit.size() - first) ? 1 : -1;
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

TEST_CASE("A closed room keeps its light, and light of others out") {
    for (const std::uint32_t n : {1u, 2u}) {
        const auto dark_room = [n](double x) {
            return [=](Scene& scene) { add_room(scene, {x, 0, 0}, {x + 2, 3, 3}, n); };
        };
        CHECK(lit_from(lit_beside_room(dark_room(5)), 6) == 0);
        CHECK(lit_from(lit_beside_room(dark_room(4)), 6) == 0); // the walls touch
        CHECK(lit_from(lit_beside_room(dark_room(3)), 6) != 0); // one runs into the other
        const auto inner = [n](Scene& s) { add_room(s, Vec3(1.0), Vec3(2.0), n); };
        CHECK(lit_from(lit_beside_room(inner), 6) == 0);
    }
    // Rooms that share all vertices of a wall.
    CHECK(lit_from(lit_beside_room([](Scene& s) { add_room(s, {4, 0, 0}, {8, 4, 4}); }), 6) == 0);
    // A piece of a wall is missing: of the dark room, of the lit one, of both.
    for (const bool dark_open : {false, true})
        for (const bool lit_open : {false, true}) {
            const std::vector<bool> lit = lit_beside_room([=](Scene& s) {
                add_room(s, {5, 0, 0}, {7, 3, 3}, 2);
                if (dark_open)
                    s.facets.erase(s.facets.begin() + 6 + 9);
                if (lit_open)
                    s.facets.erase(s.facets.begin() + 3);
            });
            CHECK((lit_from(lit, lit_open ? 5 : 6) != 0) == (dark_open && lit_open));
        }
}

TEST_CASE("A thing has the light of the space that it is in") {
    const auto block_at = [](double x, double y) {
        return [=](Scene& s) { test::add_block(s, {x, y, 1}, {x + 1, y + 1, 2}); };
    };
    CHECK(lit_from(lit_beside_room(block_at(1, 1)), 6) == 1);
    CHECK(lit_from(lit_beside_room(block_at(6, 1)), 6) == 0);
    CHECK(lit_from(lit_beside_room(block_at(6, -9)), 6) == 0);
    CHECK(lit_from(lit_beside_room(block_at(3.5, 1)), 6) != 0); // it sticks in the wall
    // On the floor of a dark room, and of the lit one, where its bottom is dark.
    const auto in_dark = lit_beside_room([](Scene& s) {
        add_room(s, {5, 0, 0}, {9, 4, 4});
        test::add_block(s, {6, 0, 1}, {7, 1, 2});
    });
    CHECK(lit_from(in_dark, 6) == 0);
    const auto in_light = lit_beside_room(block_at(1, 0));
    CHECK(std::ranges::count(in_light, false) == 1);
    // A panel of a lamp in the very plane of the dark room's ceiling, on its inside.
    const auto panel = lit_beside_room([](Scene& s) {
        add_room(s, {5, 0, 0}, {9, 4, 4});
        test::add_quad(s, {6, 4, 1}, {7, 4, 1}, {7, 4, 2}, {6, 4, 2}, 1, 1, lamp);
        test::add_block(s, {11, 1, 1}, {12, 2, 2});
    });
    CHECK(lit_from({panel.begin(), panel.begin() + 12}, 6) != 0);
    CHECK(lit_from(panel, 13) == 0);
}

TEST_CASE("The outside of a room of any shape gets no light of the inside") {
    Scene scene = test::furnace_l_shape(.5, 0);
    add_point_emitter(scene, {.name = "bulb", .position = Vec3(.1), .intensity = Vec3(1.0)});
    const Mesh mesh(scene, {.two_sided = true});
    const std::vector<bool> lit = find_lit_patches(mesh);
    for (std::size_t i = 0; i < lit.size(); ++i)
        CHECK(lit[i] == !mesh.patches()[i].back);
}

TEST_CASE("A light without extent lights the space that it is in") {
    Scene scene = nothing();
    add_room(scene, Vec3(0.0), Vec3(4.0));
    add_room(scene, {5, 0, 0}, {9, 4, 4});
    add_point_emitter(scene, {.name = "bulb", .position = {6, 1, 1}, .intensity = Vec3(1.0)});
    const std::vector<bool> lit = find_lit_patches(Mesh(scene));
    CHECK(std::ranges::count(lit, true) == 6);
    CHECK(lit_from(lit, 6) == 1);
}

TEST_CASE("A facet under another of its plane is dark") {
    const auto sheets = [](double width) {
        return [=](Scene& s) {
            for (const double w : {width, 2.0})
                test::add_quad(s, {1, 1, 1}, {1, 1, 1 + w}, {1 + w, 1, 1 + w}, {1 + w, 1, 1}, 1, 1,
                               white);
        };
    };
    const std::vector<bool> twins = lit_beside_room(sheets(2));
    CHECK(twins[6] != twins[7]);
    CHECK(lit_from(lit_beside_room(sheets(1)), 6) == 1); // a small one lies on a large one
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
    CHECK(dark > without_hits / 2);
}
