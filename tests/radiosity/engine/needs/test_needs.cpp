// What is left out changes nothing: the same solution with all that is not needed and without it.
#include "parallel/workers.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/engine/factors/pairs/point_to_patch.h"
#include "radiosity/engine/needs/convex_enclosure.h"
#include "radiosity/engine/needs/find_needs.h"
#include "radiosity/engine/needs/lit_facets.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/solving/left_out.h"
#include "radiosity/engine/solving/own_options.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/guides.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace hemilux;
using test::Model;

namespace {

Scene grey_cube() { return test::cube_with_lit_floor(3, .5); }

Scene with_reflectance(Scene scene, const Vec3& reflectance) {
    for (Material& material : scene.materials)
        material.reflectance = reflectance;
    return scene;
}

/// The room's walls and one of its blocks are of the first material.
Scene room_with_black_walls() {
    Scene scene = test::room_with_block();
    scene.materials[0].reflectance = Vec3(0.0);
    return scene;
}

SolveOptions with_rays(double rays, bool literal = false) {
    SolveOptions options;
    options.rays = rays;
    options.literal = literal;
    options.seed = 5;
    return options;
}

Solution solve_with(const Mesh& mesh, const Needs& needs, const Method& method,
                    const SolveOptions& options, std::uint32_t steps) {
    Monitor monitor;
    const MadeTracer made = make_tracer(mesh);
    const SolverInput input{mesh, *made.tracer, options, monitor, needs};
    const auto solver = method.make(input);
    run(*solver, input, test::steps(steps));
    return solver->solution();
}

bool lists(const std::vector<LeftOut>& list, const std::string& what) {
    return std::ranges::any_of(
        list, [&](const LeftOut& item) { return item.what.find(what) != std::string::npos; });
}

/// Quads of any place, size and attitude; every fifth shines, every third reflects.
Scene random_quads(std::uint32_t n, std::uint64_t seed, double size) {
    Scene scene;
    scene.materials = {{"lamp", Vec3(0.0), Vec3(1.0)},
                       {"white", Vec3(.5), Vec3(0.0)},
                       {"black", Vec3(0.0), Vec3(0.0)}};
    scene.groups = {"default"};
    Rng rng(seed);
    const auto vector = [&] { return Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - .5; };
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec3 corner = 2.0 * vector(), u = size * vector(), v = size * vector();
        test::add_quad(scene, corner, corner + u, corner + u + v, corner + v, 1, 1,
                       i % 5 == 0   ? 0
                       : i % 3 == 0 ? 1
                                    : 2);
    }
    return scene;
}

/// The same growth, patch by patch.
std::vector<bool> lit_by_looking_at_all_pairs(const Mesh& mesh) {
    const auto patches = mesh.patches();
    const auto above = [](const Patch& patch, const Patch& plane) {
        return std::ranges::any_of(patch.shape.corner, [&](const Vec3& p) {
            return glm::dot(plane.normal, p - plane.centre) > 1e-12;
        });
    };
    std::vector<bool> lit(patches.size()), shines(patches.size());
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        shines[i] = mesh.material(i).emission != Vec3(0.0);
    for (bool grows = true; grows;) {
        grows = false;
        for (std::uint32_t i = 0; i < patches.size(); ++i)
            for (std::uint32_t j = 0; j < patches.size() && !lit[i]; ++j)
                if (shines[j] && above(patches[i], patches[j]) && above(patches[j], patches[i])) {
                    lit[i] = grows = true;
                    shines[i] = shines[i] || mesh.material(i).reflectance != Vec3(0.0);
                }
    }
    return lit;
}

} // namespace

TEST_CASE("A closed convex room is told from all else") {
    const auto convex = [](const Scene& scene) {
        return convex_enclosure(Mesh(scene)) == Enclosure::tight;
    };
    CHECK(convex(grey_cube()));
    CHECK(convex(test::furnace_box(1, .5)));
    CHECK(convex(test::sphere(3, 2, .5, 1)));
    CHECK_FALSE(convex(test::furnace_l_shape(.5)));
    CHECK_FALSE(convex(test::room_with_block()));
    CHECK_FALSE(convex(test::open_scene()));

    Scene open = grey_cube();
    open.facets.pop_back();
    CHECK_FALSE(convex(open));
    Scene doubled = grey_cube();
    doubled.facets.push_back(doubled.facets.back());
    CHECK_FALSE(convex(doubled));
    Scene turned = grey_cube();
    std::ranges::reverse(turned.facets[0].vertex);
    CHECK_FALSE(convex(turned));
    Scene outside = grey_cube();
    for (Facet& facet : outside.facets)
        std::ranges::reverse(facet.vertex);
    CHECK_FALSE(convex(outside));
    // One wall is missing and its opposite is there twice.
    Scene wrong = test::furnace_box(1, .5);
    wrong.facets[0] = wrong.facets[1];
    CHECK_FALSE(convex(wrong));
    // A vertex pushed inwards, or outwards so that a wall has a fold.
    for (const double to : {.2, -.2}) {
        Scene dented = grey_cube();
        for (Vec3& v : dented.vertices)
            if (v.x == 0 && v.y > .3 && v.y < .4 && v.z > .3 && v.z < .4)
                v.x = to;
        CHECK(convex(dented) == (to < -1));
    }
    // Vertices that no face uses do not matter; those written twice are one.
    Scene untidy = grey_cube();
    untidy.vertices.push_back({9, 9, 9});
    untidy.vertices.push_back(untidy.vertices[untidy.facets[0].vertex[0]]);
    untidy.facets[0].vertex[0] = static_cast<std::uint32_t>(untidy.vertices.size() - 1);
    CHECK(convex(untidy));
}

namespace {

/// A cube whose ceiling is of n x n quads, with the lamp in the middle, and whose walls are whole.
/// It is turned, so that coordinates are rounded.
Scene cube_with_cut_ceiling(std::uint32_t n) {
    Scene scene = test::box_room(Vec3(0.0), Vec3(1.0), 1, {{"wall", Vec3(.5), Vec3(0.0)}},
                                 {0, 0, 0, 0, 0, 0});
    std::erase_if(scene.facets, [&](const Facet& facet) {
        return std::ranges::all_of(facet.vertex, [&](auto v) { return scene.vertices[v].y == 1; });
    });
    scene.materials.push_back({"lamp", Vec3(.3), Vec3(4.0)});
    const auto at = [n](std::uint32_t k) { return double(k) / n; };
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            test::add_quad(scene, {at(i), 1, at(j)}, {at(i + 1), 1, at(j)},
                           {at(i + 1), 1, at(j + 1)}, {at(i), 1, at(j + 1)}, 1, 1,
                           i == n / 2 && j == n / 2 ? 1 : 0);
    for (Vec3& v : scene.vertices)
        v = Vec3(.8 * v.x - .6 * v.y, .6 * v.x + .8 * v.y, v.z);
    return scene;
}

} // namespace

TEST_CASE("A convex room whose walls are cut at different points is one, and may leak") {
    const auto room = [](const Scene& scene) { return convex_enclosure(Mesh(scene)); };
    CHECK(room(grey_cube()) == Enclosure::tight);
    CHECK(room(cube_with_cut_ceiling(1)) == Enclosure::tight);
    for (const std::uint32_t n : {2u, 3u, 7u}) {
        const Scene cut = cube_with_cut_ceiling(n);
        CHECK(room(cut) == Enclosure::cut_edges);
        CHECK_FALSE(find_needs(Mesh(cut)).visibility);
        CHECK_FALSE(find_needs(Mesh(cut)).closed);
        for (std::size_t gone = 0; gone < cut.facets.size(); ++gone) {
            Scene open = cut;
            open.facets.erase(open.facets.begin() + std::ptrdiff_t(gone));
            CHECK(room(open) == Enclosure::not_found);
            Scene doubled = cut;
            doubled.facets.push_back(cut.facets[gone]);
            CHECK(room(doubled) == Enclosure::not_found);
            Scene turned = cut;
            std::ranges::reverse(turned.facets[gone].vertex);
            CHECK(room(turned) == Enclosure::not_found);
        }
    }
    Scene apart = cube_with_cut_ceiling(2); // a corner off the edge by more than rounding
    const Vec3 corner = apart.vertices[apart.facets.back().vertex[1]];
    for (Vec3& v : apart.vertices)
        if (v == corner)
            v -= 1e-3 * Vec3(.8, .6, 0);
    CHECK(room(apart) == Enclosure::not_found);
}

TEST_CASE("In a convex enclosure all densities are 1 and nothing hides a patch") {
    for (const Scene& scene : {grey_cube(), test::sphere(2, 1, .5, 1), cube_with_cut_ceiling(3)}) {
        const Model model(scene);
        const Hemisphere hemisphere(2);
        Monitor monitor;
        const DensityMap map(model.mesh, model.bvh, hemisphere, 0, Workers(1), monitor);
        std::vector<DensityCount> counts;
        Rng rng(3);
        for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
            map.counts(i, counts);
            CHECK(std::ranges::all_of(counts, [](const auto& c) { return c.surfaces == 1; }));
            for (std::uint32_t j = 0; j < model.mesh.patches().size(); ++j) {
                const std::array<double, 4> u{rng.uniform(), rng.uniform(), rng.uniform(),
                                              rng.uniform()};
                std::uint64_t rays = 0, none_traced = 0;
                const PairLook look(model.mesh, model.bvh, i, j, everywhere);
                const PairLook blind(model.mesh, model.bvh, i, j, everywhere, false);
                const double seen = look.factor(u, rays);
                CHECK(blind.factor(u, none_traced) == seen);
                CHECK(none_traced == 0);
            }
        }
    }
}

TEST_CASE("Patches that no light can reach are those that a look at all pairs finds") {
    std::size_t dark = 0, all = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed)
        for (const bool two_sided : {false, true}) {
            // From scattered tiles to such that cross the whole scene.
            const Scene scene = random_quads(5 + 3 * static_cast<std::uint32_t>(seed), seed,
                                             seed % 4 == 0 ? 2 : .2);
            const Mesh mesh(scene, {.two_sided = two_sided});
            const std::vector<bool> lit = find_lit_patches(mesh);
            CAPTURE(seed, two_sided);
            CHECK(lit == lit_by_looking_at_all_pairs(mesh));
            dark += static_cast<std::size_t>(std::ranges::count(lit, false));
            all += lit.size();
        }
    CHECK(dark > all / 1000);
    for (const Scene& scene : {test::room_with_block(), test::open_scene(), grey_cube(),
                               test::furnace_l_shape(.5), test::sphere(3, 1, .5, 1)}) {
        const Mesh mesh(scene, {.two_sided = true});
        const std::vector<bool> lit = find_lit_patches(mesh);
        CHECK(lit == lit_by_looking_at_all_pairs(mesh));
        CHECK(std::ranges::count(lit, false) > 0);
    }
}

TEST_CASE("No ray strikes a patch that no light can reach") {
    for (const Scene& scene : {test::room_with_block(), random_quads(60, 4, .2)}) {
        const Mesh mesh(scene, {.two_sided = true});
        const std::vector<bool> lit = find_lit_patches(mesh);
        const Solution s =
            solve_with(mesh, everything_needed, *find_method("stratified"), with_rays(1000), 2);
        REQUIRE(std::ranges::count(lit, false) > 0);
        for (std::size_t i = 0; i < lit.size(); ++i)
            if (!lit[i])
                CHECK(s.hits[i] == 0);
    }
}

TEST_CASE("A quad that is bent, or hardly has an area, is taken to be lit") {
    Scene scene;
    scene.materials = {{"lamp", Vec3(0.0), Vec3(1.0)}, {"white", Vec3(.5), Vec3(0.0)}};
    scene.groups = {"default"};
    // A lamp that shines up, and above it something that looks up as well.
    test::add_quad(scene, {-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, 1, 1, 0);
    test::add_quad(scene, {-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, 1, 1, 1);
    CHECK(find_lit_patches(Mesh(scene)) == std::vector<bool>{false, false});
    Scene bent = scene;
    bent.vertices[bent.facets[1].vertex[2]].y = 2;
    CHECK(find_lit_patches(Mesh(bent))[1]);
    Scene thin = scene;
    thin.vertices[thin.facets[1].vertex[2]] = {-1, 1, 1};
    thin.vertices[thin.facets[1].vertex[3]] = {-1 + 1e-15, 1, -1};
    CHECK(find_lit_patches(Mesh(thin))[1]);
}

namespace {

/// What a scene allows to be left out; where several do, the first of these decides.
enum class Omission { black, convex, unlit, none, no_reflection };

/// The table of docs/paper/decisions.md, D35.
bool keeps_every_byte(const std::string& method, const Guide* guide, Omission omission) {
    if (omission == Omission::none || omission == Omission::no_reflection)
        return true;
    if (guide && guide->densities) // no patch counts in another's place
        return omission != Omission::convex;
    if (method == "stored-transport" || guide)
        return false;
    if (method == "progressive")
        return omission == Omission::unlit;
    if (method == "matrix")
        return omission != Omission::black;
    return true;
}

/// Nothing is left out, as by --keep-all; that a scene is closed is known all the same.
Needs everything_of(const Mesh& mesh) {
    Needs needs = everything_needed;
    needs.closed = find_needs(mesh).closed;
    return needs;
}

void check_same_bytes(const Solution& with, const Solution& without, Omission omission) {
    CHECK(with.radiosity == without.radiosity);
    if (omission == Omission::no_reflection) // one step: the energy ledger is less exact
        return;
    CHECK(with.standard_error == without.standard_error);
    CHECK(with.energy.absorbed == without.energy.absorbed);
    CHECK(with.energy.escaped == without.energy.escaped);
    CHECK(with.rays_energy <= without.rays_energy);
}

/// The difference, root mean square over areas, against the errors that both report; these are
/// rough, as few batches estimate them, and whole patches may err alike.
void check_agreement(const Mesh& mesh, const Solution& with, const Solution& without) {
    double difference = 0, error = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double area = mesh.patches()[i].area;
            const double d = with.radiosity[i][c] - without.radiosity[i][c];
            difference += area * d * d;
            error += area * (std::pow(with.standard_error[i][c], 2) +
                             std::pow(without.standard_error[i][c], 2));
        }
    CAPTURE(std::sqrt(difference), std::sqrt(error));
    CHECK(std::isfinite(error));
    CHECK(std::sqrt(difference) < 3 * std::sqrt(error));
}

} // namespace

TEST_CASE("What is left out keeps every byte where that is promised, else the result", "[slow]") {
    struct Case {
        Scene scene;
        MeshOptions options;
        Omission omission;
        std::vector<std::string> what;
    };
    const std::vector<Case> cases{
        {grey_cube(), {}, Omission::convex, {"colour", "densities", "visibility"}},
        {cube_with_cut_ceiling(3), {.max_edge = .4}, Omission::convex, {"densities", "visibility"}},
        {test::sphere(0, 1, .5, 1), {.max_edge = .4}, Omission::convex, {"colour", "densities"}},
        {test::sphere(2, 1, .5, 1), {}, Omission::convex, {"densities"}},
        {test::room_with_block(), {.two_sided = true}, Omission::unlit, {"no light"}},
        {room_with_black_walls(), {}, Omission::black, {"reflect"}},
        {test::open_scene(), {}, Omission::none, {}},
        {with_reflectance(test::room_with_block(), Vec3(0.0)),
         {},
         Omission::no_reflection,
         {"passes", "reflect"}},
    };
    for (const Case& c : cases) {
        const Mesh mesh(c.scene, c.options);
        const Needs needs = find_needs(mesh);
        for (const std::string& what : c.what)
            CHECK((lists(left_out(needs), what) ||
                   std::ranges::any_of(left_out(needs), [&](const LeftOut& item) {
                       return item.why.find(what) != std::string::npos;
                   })));
        for (const Method* method : methods())
            for (const bool literal : {false, true})
                for (const Guide* const guide : test::all_guides()) {
                    if (literal && !method->has_literal)
                        continue;
                    if (guide && (literal || method->name != "hemisphere"))
                        continue;
                    const std::string name(method->name);
                    const bool bytes = keeps_every_byte(name, guide, c.omission);
                    SolveOptions options = with_rays(bytes ? 4 : 64, literal);
                    set_own_options(options, GuideChoice{.guide = guide});
                    const std::uint32_t steps = bytes ? 2 : 6;
                    const Solution with = solve_with(mesh, needs, *method, options, steps);
                    options.keep_all = true;
                    const Solution without =
                        solve_with(mesh, everything_of(mesh), *method, options, steps);
                    CAPTURE(name, literal, guide ? guide->name : "", &c - cases.data());
                    if (bytes)
                        check_same_bytes(with, without, c.omission);
                    else
                        check_agreement(mesh, with, without);
                }
    }
}

// Black patches shoot no rays, so that their pairs are known from one side alone.
TEST_CASE("Without the rays of black patches factors agree within the standard errors") {
    const Mesh mesh(room_with_black_walls());
    const Needs needs = find_needs(mesh);
    REQUIRE(needs.black > mesh.patches().size() / 2);
    const std::string name = GENERATE("matrix", "stored-transport");
    CAPTURE(name);
    const Method& method = *find_method(name);
    const std::uint32_t steps = name == "matrix" ? 2 : 7;
    const Solution with = solve_with(mesh, needs, method, with_rays(256), steps);
    const Solution without = solve_with(mesh, everything_of(mesh), method, with_rays(256), steps);
    if (name == "matrix")
        CHECK(with.rays_energy < without.rays_energy / 2);
    double mean = 0;
    std::size_t count = 0, far = 0;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        if (!needs.power(i)) {
            CHECK(with.radiosity[i] == mesh.material(i).emission);
            continue;
        }
        const double sigma = std::hypot(with.standard_error[i].r, without.standard_error[i].r);
        if (!(sigma > 0))
            continue;
        const double z = (with.radiosity[i].r - without.radiosity[i].r) / sigma;
        mean += z;
        ++count;
        far += std::abs(z) > 4;
    }
    REQUIRE(count > 10);
    // Errors that all patches share show in the mean; four sets tell them roughly.
    CHECK(std::abs(mean / static_cast<double>(count)) < (name == "matrix" ? .6 : 1.5));
    CHECK(far <= (name == "matrix" ? 0 : count / 20)); // with four sets errors are rough
    for (int c = 0; c < 3; ++c) {
        const double balance = with.energy.absorbed[c] + with.energy.escaped[c];
        CHECK(balance == Approx(with.energy.emitted[c]).epsilon(.005));
        CHECK(with.energy.absorbed[c] == Approx(without.energy.absorbed[c]).epsilon(.02));
    }
}

TEST_CASE("Where nothing reflects one step gives emission, without a standard error") {
    const Mesh mesh(with_reflectance(test::room_with_block(), Vec3(0.0)));
    const Needs needs = find_needs(mesh);
    CHECK_FALSE(needs.bounces);
    for (const Method* method : methods()) {
        if (!method->unbiased && method->name != "matrix")
            continue;
        const Solution s = solve_with(mesh, needs, *method, with_rays(64), 16);
        CAPTURE(method->name);
        CHECK(s.steps == 1);
        CHECK(estimated_error(mesh, s) == 0);
        for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
            CHECK(s.radiosity[i] == mesh.material(i).emission);
        for (int c = 0; c < 3; ++c)
            CHECK(s.energy.absorbed[c] + s.energy.escaped[c] ==
                  Approx(s.energy.emitted[c]).epsilon(1e-6));
    }
}

TEST_CASE("Patches that never hold power have no densities") {
    const Mesh mesh(test::room_with_block(), {.two_sided = true});
    const Needs needs = find_needs(mesh);
    const Method& method = *find_method("hemisphere");
    const Solution with = solve_with(mesh, needs, method, with_rays(8), 1);
    SolveOptions keep_all = with_rays(8);
    keep_all.keep_all = true;
    const Solution all = solve_with(mesh, everything_needed, method, keep_all, 1);
    REQUIRE(needs.unlit > 20);
    CHECK(needs.black == 0);
    CHECK(with.rays_density + with.rays_density_spared ==
          41 * (mesh.patches().size() - needs.unlit));
    CHECK(all.rays_density == 41 * mesh.patches().size());
    CHECK(with.bytes_density < all.bytes_density - 30 * needs.unlit);
    CHECK(lists(left_out(needs, method.work, with), "densities of"));
    CHECK(lists(left_out(needs, find_method("matrix")->work, with), "rays of"));
    CHECK(left_out(needs, find_method("monte-carlo")->work, with).empty());
}

TEST_CASE("A full density store has the same leaves as one of the divided triangles") {
    const Model model(test::open_scene());
    const Hemisphere hemisphere(2);
    Monitor monitor;
    const auto make = [&](DensityStore kept) {
        return DensityMap(model.mesh, model.bvh, hemisphere, 1, Workers(1), monitor,
                          everything_needed, kept);
    };
    const DensityMap divided = make(DensityStore::divided_only),
                     full = make(DensityStore::everything);
    CHECK(full.rays() == 41 * model.mesh.patches().size());
    CHECK(full.rays_spared() == 0);
    CHECK(divided.rays() + divided.rays_spared() == full.rays());
    CHECK(divided.bytes() < full.bytes() / 2);
    std::vector<DensityLeaf> a, b;
    std::vector<DensityCount> c, d;
    for (std::uint32_t i = 0; i < model.mesh.patches().size(); ++i) {
        divided.leaves(i, a);
        full.leaves(i, b);
        divided.counts(i, c);
        full.counts(i, d);
        CHECK(std::ranges::equal(a, b, [](const DensityLeaf& x, const DensityLeaf& y) {
            return x.cell == y.cell && x.density == y.density;
        }));
        CHECK(std::ranges::equal(c, d, [](const DensityCount& x, const DensityCount& y) {
            return x.vertex == y.vertex && x.surfaces == y.surfaces;
        }));
    }
}

TEST_CASE("A channel is solved unless another is the same in all materials in use, or it is dark") {
    const auto channels = [](const Scene& scene) { return find_needs(Mesh(scene)).channel; };
    using Channels = std::array<int, 3>;
    constexpr int dark = Needs::dark;
    Scene scene = grey_cube();
    CHECK(channels(scene) == Channels{0, 0, 0});
    scene.materials.push_back({"unused", {.1, .2, .3}, Vec3(0.0)});
    CHECK(channels(scene) == Channels{0, 0, 0});
    scene.materials[0].reflectance.g = .51;
    CHECK(channels(scene) == Channels{0, 1, 0});
    scene.materials[1].emission.b = 2;
    CHECK(channels(scene) == Channels{0, 1, 2});
    scene.materials[1].emission = {0, 1, 0};
    CHECK(channels(scene) == Channels{dark, 1, dark});
    add_point_emitter(scene, {.name = "bulb", .position = Vec3(.5), .intensity = {0, 0, 1}});
    CHECK(channels(scene) == Channels{dark, 1, 2});
}
