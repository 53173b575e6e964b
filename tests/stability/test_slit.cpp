// Two rooms joined by a slit of a thousandth of a wall, light in one of them: hardly any ray
// passes, and all light of the other room does. The wall is a sheet with a face for each room.
#include "geometry/horizon_clip.h"
#include "radiosity/engine/factors/pairs/exchange_area.h"
#include "radiosity/engine/sampling/sobol.h"
#include "support/catch.h"
#include "support/layered_model.h"
#include "support/scenes.h"
#include "support/sobol.h"
#include "support/solve.h"

#include <numbers>

using namespace hemilux;
using test::add_quad;
using Model = test::LayeredModel;
using test::sobol4;

namespace {

constexpr double slit_low = .4995, slit_high = .5005; ///< of z, from floor to ceiling, at x = 1

/// Unit cubes from x = 0 and x = 1, each of `patches_a_room` patches; the floor of the first
/// shines.
Scene two_rooms(double reflectance) {
    Scene scene = test::box_room(
        Vec3(0.0), Vec3(1.0), 3,
        {{"wall", Vec3(reflectance), Vec3(0.0)}, {"lit", Vec3(reflectance), Vec3(1.0)}},
        {1, 0, 0, 0, 0, 0});
    const Scene other =
        test::box_room(Vec3(1, 0, 0), Vec3(2, 1, 1), 3, scene.materials, {0, 0, 0, 0, 0, 0});
    const auto facets = [](const Scene& of, std::size_t without) {
        std::vector<Facet> kept(of.facets);
        const auto begin = kept.begin() + static_cast<std::ptrdiff_t>(9 * without);
        kept.erase(begin, begin + 9);
        return kept;
    };
    scene.facets = facets(scene, 3);
    const auto wall = [&](bool toward_first) {
        for (const auto& [low, high] : {std::pair{0.0, slit_low}, {slit_high, 1.0}}) {
            if (toward_first)
                add_quad(scene, {1, 0, low}, {1, 0, high}, {1, 1, high}, {1, 1, low}, 2, 3, 0);
            else
                add_quad(scene, {1, 0, low}, {1, 1, low}, {1, 1, high}, {1, 0, high}, 3, 2, 0);
        }
    };
    wall(true);
    const auto base = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Facet facet : facets(other, 2)) {
        for (std::uint32_t& v : facet.vertex)
            v += base;
        scene.facets.push_back(facet);
    }
    wall(false);
    return scene;
}

constexpr std::size_t patches_a_room = 57;

/// How much of a polygon a point of a surface sees through the slit, as a form factor. Both rooms
/// together are a box, so nothing else stands between, and nothing is below the horizon.
double through_slit(const Vec3& point, const Frame& frame, const Polygon& to,
                    const LocalFrame& local) {
    Outline seen = outline_of(to);
    for (const double z : {slit_low, slit_high}) {
        const Vec3 edge = local.to_local({1, 0, z});
        Vec3 normal = glm::normalize(glm::cross(edge - point, Vec3(0, 1, 0)));
        const Vec3 middle = local.to_local({1, .5, .5});
        if (glm::dot(middle - edge, normal) < 0)
            normal = -normal;
        seen = in_front(seen, {edge, normal}, 0);
        if (seen.empty())
            return 0;
    }
    double sum = 0;
    for (std::size_t i = 0; i < seen.size(); ++i)
        sum += edge_term(frame.to_local(seen[i] - point),
                         frame.to_local(seen[(i + 1) % seen.size()] - point));
    return std::abs(sum) / (2 * std::numbers::pi);
}

/// All form factors: in closed form within a room, by quadrature of the closed form between them.
std::vector<double> factors(const Mesh& mesh) {
    constexpr std::uint32_t points = 512;
    const auto patches = mesh.patches();
    const std::size_t n = patches.size();
    std::vector<double> f(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const bool together = (i < patches_a_room) == (j < patches_a_room);
            if (together && i < j)
                f[i * n + j] = exchange_area(patches[i].shape, patches[j].shape);
            else if (together)
                f[i * n + j] = f[j * n + i];
            // One way is enough. The wall between the rooms does not see the other.
            else if (i < j && facing_parts(patches[i].shape, patches[j].shape, 1e-6).from.size())
                for (std::uint32_t k = 0; k < points; ++k) {
                    const auto u = sobol4(k, i);
                    f[i * n + j] += patches[i].area / points *
                                    through_slit(patches[i].shape.sample({u[0], u[1]}),
                                                 Frame::from_normal(patches[i].normal),
                                                 patches[j].shape, mesh.frame());
                }
            else
                f[i * n + j] = f[j * n + i];
        }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            f[i * n + j] /= patches[i].area;
    return f;
}

/// B = E + rho F B by as many bounces as it takes.
std::vector<Vec3> solve(const Mesh& mesh, const std::vector<double>& f) {
    const std::size_t n = mesh.patches().size();
    std::vector<Vec3> b(n, Vec3(0.0)), next(n);
    for (int bounce = 0; bounce < 3000; ++bounce) {
        for (std::uint32_t i = 0; i < n; ++i) {
            next[i] = Vec3(0.0);
            for (std::size_t j = 0; j < n; ++j)
                next[i] += f[i * n + j] * b[j];
            next[i] = mesh.material(i).emission + mesh.material(i).reflectance * next[i];
        }
        b.swap(next);
    }
    return b;
}

/// The error of all, and that of the dark room relative to its own light.
RelativeError error_of(const Mesh& mesh, const Solution& s, const std::vector<Vec3>& right) {
    std::vector<bool> dark(mesh.patches().size());
    std::fill(dark.begin() + patches_a_room, dark.end(), true);
    return true_error(mesh, s.radiosity, right, dark);
}

} // namespace

TEST_CASE("Two rooms joined by a slit", "[slow]") {
    std::vector<double> f;
    for (const auto& [rho, max_in_the_dark] : {std::pair{.5, .3}, {.9, .1}, {.99, .15}}) {
        const Model model(two_rooms(rho));
        REQUIRE(model.mesh.patches().size() == 2 * patches_a_room);
        if (f.empty())
            f = factors(model.mesh);
        double least = 1, most = 0;
        for (std::size_t i = 0; i < 2 * patches_a_room; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < 2 * patches_a_room; ++j)
                sum += f[i * 2 * patches_a_room + j];
            least = std::min(least, sum);
            most = std::max(most, sum);
        }
        CHECK((least > .9999 && most < 1.0001)); // nothing is missing from the reference
        const std::vector<Vec3> right = solve(model.mesh, f);
        const Solution s =
            test::solve(model, *find_method("stored-transport"), {}, test::steps(11));
        const RelativeError off = error_of(model.mesh, s, right);
        CAPTURE(rho, s.rays_energy, off.all, off.detail);
        CHECK(off.all < .01);
        CHECK(off.detail < max_in_the_dark);
    }
}
