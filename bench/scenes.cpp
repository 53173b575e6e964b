#include "scenes.h"

#include "geometry/frame.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux::bench {
namespace {

/// Adds facets to a scene of one material and one group.
class Modeller {
  public:
    Modeller() {
        scene_.materials.push_back({"grey", Vec3(.5), Vec3(0.0)});
        scene_.groups.emplace_back("all");
    }

    /// n x m cells of two triangles; at(s, t) is the surface's point.
    template <class Surface>
    void grid(std::uint32_t n, std::uint32_t m, const Surface& at) {
        const auto base = static_cast<std::uint32_t>(scene_.vertices.size());
        for (std::uint32_t j = 0; j <= m; ++j)
            for (std::uint32_t i = 0; i <= n; ++i)
                scene_.vertices.push_back(at(double(i) / n, double(j) / m));
        for (std::uint32_t j = 0; j < m; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const std::uint32_t a = base + j * (n + 1) + i, d = a + n + 1;
                triangle(a, a + 1, d + 1);
                triangle(a, d + 1, d);
            }
    }

    /// Six sides of n x n cells, seen from outside, or from inside.
    void box(const Vec3& centre, const Frame& frame, const Vec3& half, std::uint32_t n,
             bool inside) {
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                Vec3 normal(0.0), u(0.0), v(0.0);
                normal[axis] = sign;
                u[(axis + 1) % 3] = (sign > 0) == inside ? -1 : 1;
                v[(axis + 2) % 3] = 1;
                grid(n, n, [&](double s, double t) {
                    return centre +
                           frame.to_world(half * (normal + (2 * s - 1) * u + (2 * t - 1) * v));
                });
            }
    }

    void sphere(const Vec3& centre, double radius, std::uint32_t n) {
        grid(n, n / 2, [&](double s, double t) {
            const double phi = 2 * std::numbers::pi * s, theta = std::numbers::pi * (1 - t);
            return centre + radius * Vec3(std::sin(theta) * std::cos(phi),
                                          std::sin(theta) * std::sin(phi), std::cos(theta));
        });
    }

    [[nodiscard]] Scene take() { return std::move(scene_); }

  private:
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Vec3 &p = scene_.vertices[a], &q = scene_.vertices[b], &r = scene_.vertices[c];
        if (glm::length(glm::cross(q - p, r - p)) > 1e-12) // a sphere's poles
            scene_.facets.push_back({{a, b, c, c}, scene_.faces++, 0, 0});
    }

    Scene scene_;
};

Frame standing(double angle) { return Frame{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}.turned(angle); }

} // namespace

Scene cornell_box(std::uint32_t n) {
    Modeller m;
    m.box(Vec3(0, 0, 1), standing(0), Vec3(1.0), n, true);
    m.box(Vec3(.37, -.3, .3), standing(.3), Vec3(.3, .3, .299), n / 2, false);
    m.box(Vec3(-.35, .3, .6), standing(-.3), Vec3(.3, .3, .599), n / 2, false);
    return m.take();
}

Scene cluttered_room(std::uint32_t n) {
    Modeller m;
    m.box(Vec3(0, 0, 1), standing(0), Vec3(2, 1.5, 1), n, true);
    Rng rng(2024);
    for (int k = 0; k < 24; ++k) {
        const double x = rng.uniform(), y = rng.uniform(), turn = rng.uniform();
        const double a = rng.uniform(), b = rng.uniform(), c = rng.uniform();
        const Vec3 half(.04 + .3 * a * a, .04 + .2 * b * b, .03 + .5 * c * c);
        m.box(Vec3(3.2 * x - 1.6, 2.2 * y - 1.1, half.z + .001 * (k + 1)), standing(6 * turn), half,
              std::max(1u, n / 4), false);
    }
    for (int k = 0; k < 24; ++k) {
        const double x = rng.uniform(), y = rng.uniform(), z = rng.uniform(), r = rng.uniform();
        const double radius = .03 + .17 * r * r;
        m.sphere(Vec3(3.4 * x - 1.7, 2.4 * y - 1.2, .25 + 1.5 * z), radius, n);
    }
    return m.take();
}

} // namespace hemilux::bench
