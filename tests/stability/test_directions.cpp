// Rays that run exactly through vertices and edges, along axes and within planes: nothing leaks, no
// surface is counted twice, and all tracers and all forms of a question agree.
#include "bvh/brute_force.h"
#include "bvh/bvh.h"
#include "bvh/wide/wide_bvh.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "radiosity/paper/hemisphere/hemisphere.h"
#include "radiosity/paper/sampling/rng.h"
#include "support/catch.h"
#include "support/directions.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <limits>

using namespace hemilux;

namespace {

Scene oblique(Scene scene) {
    const Frame frame = Frame::from_normal(glm::normalize(Vec3(.3, .5, .8))).turned(.7);
    for (Vec3& v : scene.vertices)
        v = frame.to_world(v);
    return scene;
}

/// The walls of a closed mesh, seen from inside, by all tracers.
struct Closed {
    Mesh mesh;
    BruteForce brute;
    Bvh bvh;
    WideBvh wide;
    std::vector<std::unique_ptr<WideBvh>> kernels; ///< of all instruction sets that run here
    bool convex;

    Closed(const Scene& scene, bool is_convex)
        : mesh(scene), brute(mesh.soup()), bvh(mesh.soup()), wide(mesh.soup()), convex(is_convex) {
        for (const InstructionSet set : available_instruction_sets())
            kernels.push_back(
                std::make_unique<WideBvh>(mesh.soup(), WideBvhOptions{.kernels = set}));
    }

    [[nodiscard]] std::vector<const Tracer*> tracers() const {
        std::vector<const Tracer*> all{&brute, &bvh, &wide};
        for (const auto& tracer : kernels)
            all.push_back(tracer.get());
        return all;
    }
    /// Vertices and the middles of edges; those of facets that the quads' diagonals divide too.
    [[nodiscard]] std::vector<Vec3> nasty_points() const {
        std::vector<Vec3> points(mesh.vertices().begin(), mesh.vertices().end());
        for (const Patch& patch : mesh.patches()) {
            const auto& c = patch.shape.corner;
            for (std::size_t i = 0; i < 4; ++i)
                points.push_back(.5 * (c[i] + c[(i + 1) % 4]));
            points.push_back(.5 * (c[0] + c[2]));
        }
        return points;
    }
};

struct Answer {
    std::uint32_t facet, count;
    bool front, blocked;
    bool operator==(const Answer&) const = default;
};

Answer ask_one(const Tracer& tracer, const Ray& ray) {
    const auto hit = tracer.closest(ray);
    if (hit)
        REQUIRE(std::isfinite(hit->t + hit->u + hit->v));
    return {hit ? hit->facet : none, tracer.count(ray), hit && hit->front, tracer.occluded(ray)};
}

std::vector<Answer> ask_stream(const Tracer& tracer, const std::vector<Ray>& rays) {
    std::vector<FacetHit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    tracer.closest_stream(rays, hits);
    tracer.occluded_stream(rays, std::vector<std::uint32_t>(rays.size(), none), blocked);
    std::vector<Answer> answer;
    for (std::size_t k = 0; k < rays.size(); ++k)
        answer.push_back({hits[k].facet, tracer.count(rays[k]), hits[k].front, blocked[k] != 0});
    return answer;
}

/// All answers to rays from one origin, which are the same whoever is asked and how.
std::vector<Answer> ask_all(const Closed& room, const std::vector<Ray>& rays) {
    std::vector<Answer> right;
    for (const Ray& ray : rays)
        right.push_back(ask_one(room.brute, ray));
    for (const Tracer* const tracer : room.tracers()) {
        std::vector<Answer> single;
        for (const Ray& ray : rays)
            single.push_back(ask_one(*tracer, ray));
        CHECK((single == right));
        CHECK((ask_stream(*tracer, rays) == right));
    }
    return right;
}

/// From inside, a ray strikes a front first and crosses the surface an odd number of times: out,
/// or out, in and out.
void check_inside(const Closed& room, const std::vector<Ray>& rays) {
    std::size_t leaks = 0, wrong_counts = 0;
    for (const Answer& answer : ask_all(room, rays)) {
        leaks += answer.facet == none || !answer.blocked;
        wrong_counts += room.convex ? answer.count != 1 : answer.count % 2 != 1;
    }
    CHECK(leaks == 0);
    CHECK(wrong_counts == 0);
}

/// As they are, or of unit length.
std::vector<Ray> aimed(const Vec3& origin, const std::vector<Vec3>& points, bool unit,
                       std::uint32_t from = none) {
    std::vector<Ray> rays;
    for (const Vec3& point : points) {
        Ray ray{origin, unit ? glm::normalize(point - origin) : point - origin};
        ray.from = from;
        rays.push_back(ray);
    }
    return rays;
}

const Closed& box() {
    static const Closed room(test::box_room(Vec3(-1.0), Vec3(1.0), 4,
                                            {{"wall", Vec3(.5), Vec3(0.0)}}, {0, 0, 0, 0, 0, 0}),
                             true);
    return room;
}
const Closed& ball() {
    static const Closed room(test::sphere(2, 1, .5, 0), true);
    return room;
}
const Closed& corner_room() {
    static const Closed room(test::furnace_l_shape(.5), false);
    return room;
}
const Closed& oblique_box() {
    static const Closed room(oblique(test::furnace_box(4, .5)), true);
    return room;
}
const Closed& oblique_corner_room() {
    static const Closed room(oblique(test::furnace_l_shape(.5)), false);
    return room;
}

} // namespace

TEST_CASE("Rays at vertices and edges of a closed mesh from anywhere inside") {
    for (const Closed* const room :
         {&box(), &ball(), &corner_room(), &oblique_box(), &oblique_corner_room()}) {
        const std::vector<Vec3> points = room->nasty_points();
        // The middle of all, which is on diagonals, and points with nothing special about them.
        for (const Vec3& origin : {Vec3(-.25, 0, -.25), Vec3(-.2137, .0411, -.2518)}) {
            const Answer there = ask_one(room->brute, {origin, {.3, .4, .5}});
            REQUIRE(there.count % 2 == 1);
            for (const bool unit : {false, true})
                check_inside(*room, aimed(origin, points, unit));
        }
    }
}

TEST_CASE("Rays along axes, through rows of vertices and edges") {
    std::vector<Vec3> axes;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0)
                    axes.emplace_back(x, y, z);
    // Places in the local frame with the mesh's own coordinates, all of them inside.
    for (const double x : {-.375, -.25, 0.0})
        for (const double y : {-.25, -.125, 0.0, .125})
            for (const double z : {-.375, -.125, 0.0}) {
                const Vec3 origin(x, y, z);
                std::vector<Ray> rays;
                for (const Vec3& axis : axes)
                    rays.push_back({origin, axis});
                check_inside(box(), rays);
                if (x < 0 && z < 0 && y > -.25) // its floor
                    check_inside(corner_room(), rays);
            }
}

TEST_CASE("Rays within the plane of the wall that they start on") {
    for (const Closed* const room : {&box(), &corner_room()}) {
        for (const Patch& patch : room->mesh.patches()) {
            const auto& c = patch.shape.corner;
            const Vec3 along = c[1] - c[0], across = c[3] - c[0];
            std::vector<Ray> rays;
            for (int i = -2; i <= 2; ++i)
                for (int j = -2; j <= 2; ++j) {
                    Ray ray{patch.centre, double(i) * along + double(j) * across};
                    ray.from = patch.facet;
                    if (i != 0 || j != 0)
                        rays.push_back(ray);
                }
            for (const Answer& answer : ask_all(*room, rays)) {
                CHECK(answer.facet != none); // the edge of the next wall
                if (room->convex)
                    CHECK(answer.count <= 1); // none where that edge belongs to the floor
            }
        }
    }
}

TEST_CASE("Density rays from every patch of a closed mesh, the horizon's too") {
    const Hemisphere hemisphere(2);
    for (const Closed* const room :
         {&box(), &ball(), &corner_room(), &oblique_box(), &oblique_corner_room()}) {
        for (std::uint32_t i = 0; i < room->mesh.patches().size(); ++i) {
            const Patch& patch = room->mesh.patches()[i];
            const Frame frame = room->mesh.hemisphere_frame(i);
            std::vector<Ray> rays;
            for (const Vec3& vertex : hemisphere.vertices()) {
                rays.push_back({patch.centre, frame.to_world(density_direction(vertex))});
                rays.back().from = patch.facet;
            }
            check_inside(*room, rays);
        }
    }
}

TEST_CASE("Rays along an edge that they start on") {
    const Closed& room = box();
    for (const Patch& patch : room.mesh.patches())
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 a = patch.shape.corner[i], b = patch.shape.corner[(i + 1) % 4];
            std::vector<Ray> rays;
            for (const Vec3& direction : {b - a, a - b, patch.normal, patch.normal + (b - a)}) {
                rays.push_back({.5 * (a + b), direction});
                rays.back().from = patch.facet;
            }
            const std::vector<Answer> answer = ask_all(room, rays);
            for (const Answer& one : answer)
                CHECK(one.count <= 1);
        }
}

TEST_CASE("Rays that are none strike nothing") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const Vec3& bad : {Vec3(0.0), Vec3(nan, 0, 1), Vec3(0, infinity, 1), Vec3(nan)}) {
        const std::vector<Ray> rays(3, Ray{Vec3(0.0), bad});
        for (const Tracer* const tracer : box().tracers())
            for (const Answer& answer : ask_stream(*tracer, rays))
                CHECK((answer == Answer{none, 0, false, false}));
    }
}
