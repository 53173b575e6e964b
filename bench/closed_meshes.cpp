#include "closed_meshes.h"

#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace hemilux::bench {
namespace {

Scene empty_scene() {
    Scene scene;
    scene.materials = {{"grey", Vec3(.5), Vec3(0.0)}};
    scene.groups = {"all"};
    return scene;
}

void add_triangle(Scene& scene, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    scene.facets.push_back({{a, b, c, c}, scene.faces++, 0, 0});
}

/// Vertices by what they are made of, so that neighbours find the same one.
class Vertices {
  public:
    explicit Vertices(Scene& scene) : scene_(scene) {}
    template <class Make>
    std::uint32_t operator()(std::uint64_t a, std::uint64_t b, const Make& make) {
        const auto [at, is_new] = known_.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(scene_.vertices.size()));
        if (is_new)
            scene_.vertices.push_back(make());
        return at->second;
    }

  private:
    Scene& scene_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::uint32_t> known_;
};

struct PlaceHash {
    std::size_t operator()(const Vec3& p) const {
        const auto word = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }; // -0 is 0
        return hash_words({word(p.x), word(p.y), word(p.z)});
    }
};

void weld(Scene& scene) {
    std::unordered_map<Vec3, std::uint32_t, PlaceHash> first;
    for (Facet& facet : scene.facets)
        for (std::uint32_t& v : facet.vertex)
            v = first.try_emplace(scene.vertices[v], v).first->second;
}

/// Which part each facet belongs to, and whether all edges of a part are closed.
class Parts {
  public:
    explicit Parts(const std::vector<Facet>& facets) : parent_(facets.size()) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        std::map<Edge, std::vector<std::uint32_t>> edges;
        for (std::uint32_t f = 0; f < facets.size(); ++f)
            for (std::size_t i = 0; i < 4; ++i)
                if (const Edge edge{facets[f].vertex[i], facets[f].vertex[(i + 1) % 4]};
                    edge.first != edge.second)
                    edges[edge].push_back(f);
        std::vector<std::uint32_t> open;
        for (const auto& [edge, users] : edges) {
            const auto opposite = edges.find({edge.second, edge.first});
            const bool paired =
                users.size() == 1 && opposite != edges.end() && opposite->second.size() == 1;
            if (!paired)
                open.push_back(users.front());
            for (const std::uint32_t user : users)
                parent_[root(user)] =
                    root(opposite == edges.end() ? users.front() : opposite->second.front());
        }
        closed_.assign(facets.size(), true);
        for (const std::uint32_t f : open)
            closed_[root(f)] = false;
    }

    std::uint32_t root(std::uint32_t f) {
        while (parent_[f] != f)
            f = parent_[f] = parent_[parent_[f]];
        return f;
    }
    bool closed(std::uint32_t f) { return closed_[root(f)]; }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<std::uint32_t> parent_;
    std::vector<bool> closed_;
};

/// Six times the volume between a facet and a point: summed over a closed part, positive where
/// fronts face outward.
double volume_under(const Scene& scene, const Facet& facet, const Vec3& point) {
    const auto corner = [&](std::size_t i) { return scene.vertices[facet.vertex[i]] - point; };
    return glm::dot(corner(0), glm::cross(corner(1), corner(2))) +
           glm::dot(corner(0), glm::cross(corner(2), corner(3)));
}

} // namespace

Scene closed_sphere(int level) {
    Scene scene = empty_scene();
    scene.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    using Triangle = std::array<std::uint32_t, 3>;
    std::vector<Triangle> triangles;
    for (std::uint32_t x = 0; x < 2; ++x)
        for (std::uint32_t y = 2; y < 4; ++y)
            for (std::uint32_t z = 4; z < 6; ++z) // mirrored octants turn the other way
                triangles.push_back((x + y + z) % 2 == 0 ? Triangle{x, z, y} : Triangle{x, y, z});
    Vertices vertices(scene);
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        return vertices(a, b,
                        [&] { return glm::normalize(scene.vertices[a] + scene.vertices[b]); });
    };
    for (; level > 0; --level) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : triangles) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }
    for (const auto& [a, b, c] : triangles)
        add_triangle(scene, a, b, c);
    return scene;
}

Scene box_of_slivers(std::uint32_t n) {
    Scene scene = empty_scene();
    // Rows of vertices along the four edges in one direction.
    for (const auto& [y, z] : {std::pair{-.8, -.6}, {-.8, .6}, {.8, .6}, {.8, -.6}})
        for (std::uint32_t k = 0; k <= n; ++k)
            scene.vertices.push_back(Vec3(2.0 * k / n - 1, y, z));
    const auto at = [&](std::uint32_t row, std::uint32_t k) { return row % 4 * (n + 1) + k; };
    for (std::uint32_t row = 0; row < 4; ++row)
        for (std::uint32_t k = 0; k < n; ++k) {
            add_triangle(scene, at(row, k), at(row + 1, k), at(row + 1, k + 1));
            add_triangle(scene, at(row, k), at(row + 1, k + 1), at(row, k + 1));
        }
    for (std::uint32_t i = 1; i < 3; ++i) {
        add_triangle(scene, at(0, 0), at(i + 1, 0), at(i, 0));
        add_triangle(scene, at(0, n), at(i, n), at(i + 1, n));
    }
    return scene;
}

Scene closed_parts(const Scene& given) {
    Scene scene = given;
    weld(scene);
    Parts parts(scene.facets);
    std::map<std::uint32_t, std::pair<double, double>> volume; // signed, and in magnitude
    const auto under = [&](std::uint32_t f) {
        const std::uint32_t base = scene.facets[parts.root(f)].vertex[0];
        return volume_under(scene, scene.facets[f], scene.vertices[base]);
    };
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        auto& [sum, size] = volume[parts.root(f)];
        sum += under(f);
        size += std::abs(under(f));
    }
    std::vector<Facet> kept;
    for (std::uint32_t f = 0; f < scene.facets.size(); ++f) {
        const auto [sum, size] = volume[parts.root(f)];
        if (!parts.closed(f) || !(std::abs(sum) > 1e-6 * size))
            continue;
        Facet facet = scene.facets[f];
        auto& v = facet.vertex;
        if (sum > 0) // fronts face outward
            v = facet.is_triangle() ? std::array{v[0], v[2], v[1], v[1]}
                                    : std::array{v[0], v[3], v[2], v[1]};
        kept.push_back(facet);
    }
    scene.facets = std::move(kept);
    return scene;
}

} // namespace hemilux::bench
