#include "support/scenes.h"

#include <map>
#include <utility>

namespace hemilux::test {
namespace {

/// Index of a vertex at exactly this position, so that neighbours share vertices. They are mostly
/// among the last.
std::uint32_t vertex(Scene& scene, const Vec3& p) {
    for (auto i = static_cast<std::uint32_t>(scene.vertices.size()); i-- > 0;)
        if (scene.vertices[i] == p)
            return i;
    scene.vertices.push_back(p);
    return static_cast<std::uint32_t>(scene.vertices.size() - 1);
}

void add_facet(Scene& scene, const std::array<std::uint32_t, 4>& corners, std::uint32_t material) {
    scene.facets.push_back({corners, scene.faces++, material, 0});
}

/// The outside of an axis-aligned box without its bottom.
void add_block(Scene& scene, const Vec3& low, const Vec3& high, std::uint32_t n,
               std::uint32_t material) {
    const Vec3 a(low.x, low.y, low.z), b(high.x, low.y, low.z), c(high.x, low.y, high.z),
        d(low.x, low.y, high.z);
    const Vec3 up(0, high.y - low.y, 0);
    add_quad(scene, a + up, d + up, c + up, b + up, n, n, material);
    for (const auto& [p, q] : {std::pair{b, a}, {c, b}, {d, c}, {a, d}})
        add_quad(scene, p, q, q + up, p + up, n, n, material);
}

Scene with_materials(std::vector<Material> materials) {
    Scene scene;
    scene.materials = std::move(materials);
    scene.groups = {"default"};
    return scene;
}

} // namespace

void add_quad(Scene& scene, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
              std::uint32_t n, std::uint32_t m, std::uint32_t material) {
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        const double s = double(i) / n, t = double(j) / m;
        return vertex(scene, (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c));
    };
    for (std::uint32_t j = 0; j < m; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            add_facet(scene, {point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)},
                      material);
}

void add_block(Scene& scene, const Vec3& low, const Vec3& high) {
    const Vec3 centre = .5 * (low + high), half = .5 * (high - low);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const int across = (axis + 1) % 3, along = (axis + 2) % 3;
            Vec3 n(0.0), u(0.0), v(0.0);
            n[axis] = side * half[axis], u[across] = half[across], v[along] = side * half[along];
            const Vec3 c = centre + n;
            add_quad(scene, c - u - v, c + u - v, c + u + v, c - u + v, 1, 1, 0);
        }
}

void add_scene(Scene& scene, const Scene& other) {
    const auto vertices = static_cast<std::uint32_t>(scene.vertices.size());
    const auto materials = static_cast<std::uint32_t>(scene.materials.size());
    scene.vertices.insert(scene.vertices.end(), other.vertices.begin(), other.vertices.end());
    scene.materials.insert(scene.materials.end(), other.materials.begin(), other.materials.end());
    for (Facet facet : other.facets) {
        for (std::uint32_t& vertex : facet.vertex)
            vertex += vertices;
        facet.face += scene.faces;
        facet.material += materials;
        scene.facets.push_back(facet);
    }
    scene.faces += other.faces;
}

Scene box_room(const Vec3& low, const Vec3& high, std::uint32_t n,
               const std::vector<Material>& materials, const std::array<std::uint32_t, 6>& side) {
    Scene scene = with_materials(materials);
    const auto p = [&](int x, int y, int z) {
        return Vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    add_quad(scene, p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0), n, n, side[0]);
    add_quad(scene, p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1), n, n, side[1]);
    add_quad(scene, p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1), n, n, side[2]);
    add_quad(scene, p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0), n, n, side[3]);
    add_quad(scene, p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0), n, n, side[4]);
    add_quad(scene, p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1), n, n, side[5]);
    return scene;
}

Scene furnace_box(std::uint32_t n, double reflectance, double emission) {
    return box_room(Vec3(0.0), Vec3(1, 1.5, 2), n, {{"wall", Vec3(reflectance), Vec3(emission)}},
                    {0, 0, 0, 0, 0, 0});
}

Scene furnace_l_shape(double reflectance, double emission) {
    Scene scene = with_materials({{"wall", Vec3(reflectance), Vec3(emission)}});
    // The floor plan, counter-clockwise seen from above (x to the right, z towards the reader).
    const std::vector<Vec3> plan{{0, 0, 0}, {0, 0, 2}, {1, 0, 2}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}};
    const Vec3 up(0, 1, 0);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const Vec3 p = plan[i], q = plan[(i + 1) % plan.size()];
        const auto n = static_cast<std::uint32_t>(2 * glm::length(q - p));
        add_quad(scene, q, p, p + up, q + up, n, 2, 0);
    }
    for (const auto& [x, z] : {std::pair{0, 0}, {0, 1}, {1, 0}}) {
        const Vec3 a(x, 0, z), b(x, 0, z + 1), c(x + 1, 0, z + 1), d(x + 1, 0, z);
        add_quad(scene, a, b, c, d, 2, 2, 0);
        add_quad(scene, a + up, d + up, c + up, b + up, 2, 2, 0);
    }
    return scene;
}

Scene cube_with_lit_floor(std::uint32_t n, double reflectance) {
    return box_room(
        Vec3(0.0), Vec3(1.0), n,
        {{"wall", Vec3(reflectance), Vec3(0.0)}, {"floor", Vec3(reflectance), Vec3(1.0)}},
        {1, 0, 0, 0, 0, 0});
}

Scene sphere(int level, double radius, double reflectance, double emission) {
    Scene scene = with_materials({{"wall", Vec3(reflectance), Vec3(emission)}});
    scene.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    using Triangle = std::array<std::uint32_t, 3>;
    std::vector<Triangle> triangles;
    for (std::uint32_t x = 0; x < 2; ++x)
        for (std::uint32_t y = 2; y < 4; ++y)
            for (std::uint32_t z = 4; z < 6; ++z) // inward: mirrored octants turn the other way
                triangles.push_back((x + y + z) % 2 == 0 ? Triangle{x, z, y} : Triangle{x, y, z});
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = midpoints.try_emplace(
            {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(scene.vertices.size()));
        if (is_new)
            scene.vertices.push_back(glm::normalize(scene.vertices[a] + scene.vertices[b]));
        return at->second;
    };
    for (; level > 0; --level) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    for (Vec3& v : scene.vertices)
        v *= radius;
    for (const auto& [a, b, c] : triangles)
        add_facet(scene, {a, b, c, c}, 0);
    return scene;
}

Scene room_with_block() {
    Scene scene = box_room(Vec3(0.0), Vec3(3, 2, 3), 5,
                           {{"white", Vec3(.7, .7, .6), Vec3(0.0)},
                            {"red", Vec3(.6, .1, .1), Vec3(0.0)},
                            {"green", Vec3(.1, .5, .2), Vec3(0.0)},
                            {"lamp", Vec3(.2), Vec3(10, 8, 5)}},
                           {0, 0, 1, 2, 0, 0});
    add_quad(scene, {1.2, 1.98, 1.2}, {1.8, 1.98, 1.2}, {1.8, 1.98, 1.8}, {1.2, 1.98, 1.8}, 1, 1,
             3);
    add_block(scene, {.4, .01, .5}, {1.1, 1.1, 1.2}, 2, 0);
    add_block(scene, {1.5, .01, 1.7}, {2.6, .4, 1.8}, 2, 1);
    return scene;
}

Scene curtain_at_wall(std::uint32_t n) {
    Scene scene = box_room(Vec3(0.0), Vec3(1.0), 3,
                           {{"white", Vec3(.5), Vec3(0.0)}, {"curtain", Vec3(.2), Vec3(10, 8, 5)}},
                           {0, 0, 0, 0, 0, 0});
    add_quad(scene, {.5, .35, 0}, {.5, .35, .2}, {.5, .65, .2}, {.5, .65, 0}, n, n, 1);
    return scene;
}

Scene open_scene() {
    Scene scene = with_materials({{"ground", Vec3(.5, .5, .4), Vec3(0.0)},
                                  {"block", Vec3(.6, .2, .1), Vec3(0.0)},
                                  {"lamp", Vec3(.1), Vec3(9, 9, 6)}});
    add_quad(scene, {-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, 8, 8, 0);
    add_block(scene, {-1, .01, -.5}, {-.3, .9, .4}, 2, 1);
    add_block(scene, {.3, .01, -.2}, {.9, .5, .7}, 2, 0);
    add_quad(scene, {-.2, 1.6, -.2}, {.2, 1.6, -.2}, {.2, 1.6, .2}, {-.2, 1.6, .2}, 1, 1, 2);
    return scene;
}

} // namespace hemilux::test
