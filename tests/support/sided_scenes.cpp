#include "support/sided_scenes.h"

#include "radiosity/paper/sampling/rng.h"
#include "support/scenes.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace hemilux::test {
namespace {

enum : std::uint32_t { wall, lamp, clay };

/// y is up.
class Builder {
  public:
    Builder() {
        scene_.materials = {{"wall", Vec3(.6), Vec3(0.0)},
                            {"lamp", Vec3(.1), Vec3(8, 7, 5)},
                            {"clay", Vec3(.5), Vec3(0.0)}};
        scene_.groups = {"default"};
    }
    [[nodiscard]] Scene take() const { return scene_; }

    /// Corners counter-clockwise from the front. Shares no edge with others unless they are equal.
    Builder& sheet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                   std::uint32_t material = clay, std::uint32_t n = 1) {
        add_quad(scene_, a, b, c, d, n, n, material);
        return *this;
    }
    /// A rectangle of a plane y = height.
    Builder& level(double x0, double z0, double x1, double z1, double height, bool up,
                   std::uint32_t material = clay, std::uint32_t n = 1) {
        const Vec3 a(x0, height, z0), b(x1, height, z0), c(x1, height, z1), d(x0, height, z1);
        return up ? sheet(a, d, c, b, material, n) : sheet(a, b, c, d, material, n);
    }
    /// A rectangle of a plane x = place.
    Builder& upright(double y0, double z0, double y1, double z1, double place, bool to_plus_x,
                     std::uint32_t material = clay, std::uint32_t n = 1) {
        const Vec3 a(place, y0, z0), b(place, y1, z0), c(place, y1, z1), d(place, y0, z1);
        return to_plus_x ? sheet(a, b, c, d, material, n) : sheet(a, d, c, b, material, n);
    }
    /// Six sides in the order of box_room(); `open`: sides left out.
    Builder& box(const Vec3& low, const Vec3& high, bool inwards, std::uint32_t material = clay,
                 unsigned open = 0, std::uint32_t n = 1) {
        const double x0 = low.x, y0 = low.y, z0 = low.z, x1 = high.x, y1 = high.y, z1 = high.z;
        const auto wants = [&](unsigned side) { return !(open >> side & 1); };
        if (wants(0))
            level(x0, z0, x1, z1, y0, inwards, material, n);
        if (wants(1))
            level(x0, z0, x1, z1, y1, !inwards, material, n);
        if (wants(2))
            upright(y0, z0, y1, z1, x0, inwards, material, n);
        if (wants(3))
            upright(y0, z0, y1, z1, x1, !inwards, material, n);
        for (const bool far : {false, true})
            if (wants(far ? 5 : 4)) {
                const double z = far ? z1 : z0;
                const Vec3 a(x0, y0, z), b(x1, y0, z), c(x1, y1, z), d(x0, y1, z);
                far != inwards ? sheet(a, b, c, d, material, n) : sheet(a, d, c, b, material, n);
            }
        return *this;
    }
    Builder& room(unsigned open = 0) { return box({0, 0, 0}, {4, 3, 4}, true, wall, open, 2); }
    Builder& lamp_at(double x, double z, double height, double half, bool up) {
        return level(x - half, z - half, x + half, z + half, height, up, lamp);
    }
    Builder& bulb(const Vec3& centre, double half) {
        return box(centre - Vec3(half), centre + Vec3(half), false, lamp);
    }
    /// A ring of upright quads.
    Builder& ring(const Vec3& foot, double radius, double height, bool outwards) {
        return turned(foot, {{radius, 0}, {radius, height}}, outwards);
    }
    /// A profile of (radius, height) from below to above, turned about an upright axis.
    Builder& turned(const Vec3& foot, const std::vector<Vec2>& profile, bool outwards,
                    std::uint32_t material = clay) {
        constexpr int n = 12;
        const auto at = [&](const Vec2& p, int k) {
            const double angle = 2 * std::numbers::pi * (k % n) / n;
            return foot + Vec3(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
        };
        for (std::size_t i = 0; i + 1 < profile.size(); ++i)
            for (int k = 0; k < n; ++k) {
                const Vec3 a = at(profile[i], k), b = at(profile[i], k + 1),
                           c = at(profile[i + 1], k + 1), d = at(profile[i + 1], k);
                outwards ? sheet(a, b, c, d, material) : sheet(a, d, c, b, material);
            }
        return *this;
    }
    /// A wall of the plane x = place with a hole in its middle: 0 <= y <= 3, 0 <= z <= 4.
    Builder& holed(double place, bool to_plus_x, std::uint32_t material = wall, double low = 0,
                   double high = 3, double z0 = 0, double z1 = 4) {
        const double y[] = {low, 1, 2, high}, z[] = {z0, 1.5, 2.5, z1};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                if (i != 1 || k != 1)
                    upright(y[i], z[k], y[i + 1], z[k + 1], place, to_plus_x, material);
        return *this;
    }
    Builder& furniture() {
        box({.5, 0, .5}, {1.5, .8, 1.2}, false);
        box({2.5, 0, 2}, {3.2, 1.9, 2.6}, false);
        return box({1, 0, 2.8}, {1.4, .4, 3.2}, false);
    }
    Builder& ground(double half = 10) { return level(-half, -half, half, half, 0, true, wall, 4); }
    Builder& things_outdoors() {
        box({-3, 0, -3}, {-1, 2, -1}, false);
        box({2, 0, 1}, {3, 1, 3}, false);
        return box({2.2, 1, 1.2}, {2.8, 1.6, 1.8}, false);
    }

  private:
    Scene scene_;
};

Scene mirrored(const Scene& scene) {
    Scene both = scene;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const Vec3& v : scene.vertices)
        both.vertices.push_back({-.5 - v.x, v.y, v.z});
    for (Facet facet : scene.facets) {
        const auto v = facet.vertex;
        facet.vertex = {v[0] + first, v[3] + first, v[2] + first, v[1] + first};
        facet.face += scene.faces;
        both.facets.push_back(facet);
    }
    both.faces *= 2;
    return both;
}

void add_rooms(std::vector<SidedScene>& list) {
    const auto add = [&](const char* name, const Builder& b) { list.push_back({name, b.take()}); };
    const auto furnished = [] { return Builder().room().furniture(); };
    add("furnished", furnished().lamp_at(2, 2, 2.95, .4, false));
    add("lamp in the plane of the ceiling", furnished().lamp_at(2, 2, 3, .4, false));
    add("two lamps", furnished().lamp_at(1, 1, 2.9, .2, false).lamp_at(3, 3, 2.9, .2, false));
    add("lamp on the floor", furnished().lamp_at(2, 1.6, .01, .3, true));
    add("lamp on a table", furnished().lamp_at(1, .8, .81, .1, true));
    add("uplight", furnished().lamp_at(2, 2, 2.6, .2, true));
    add("big uplight", furnished().lamp_at(2, 2, 2.7, 1, true));
    add("lamp panel at a wall", furnished().upright(1, 1, 2, 3, .02, true, lamp));
    add("lamp that washes a wall", furnished().upright(1, 1, 2, 2, .15, false, lamp));
    add("light box under the ceiling", furnished()
                                           .box({1.5, 2.8, 1.5}, {2.5, 2.99, 2.5}, false, clay, 1)
                                           .level(1.5, 1.5, 2.5, 2.5, 2.8, false, lamp));
    add("television", furnished()
                          .box({.1, 1, 1}, {.2, 2, 3}, false, clay, 1 << 3)
                          .upright(1, 1, 2, 3, .2, true, lamp));
    add("bulb", furnished().bulb({2, 2.5, 2}, .1));
    add("lamp behind a baffle",
        furnished().lamp_at(2, 2, 2.8, .4, false).box({1.5, 2.6, 1.5}, {2.5, 2.65, 2.5}, false));
    add("lamp above a sheet",
        furnished().lamp_at(2, 2, 2.8, .4, false).level(1.5, 1.5, 2.5, 2.5, 2.6, true));
    add("lamp above a sheet that faces down",
        furnished().lamp_at(2, 2, 2.8, .4, false).level(1.5, 1.5, 2.5, 2.5, 2.6, false));
    add("panel lamp behind a near baffle",
        furnished().lamp_at(2, 2, 2.9, .5, false).level(1.4, 1.4, 2.6, 2.6, 2.8, true));
    add("cove", furnished()
                    .level(.02, .5, .12, 3.5, 2.7, true, lamp)
                    .box({.01, 2.6, .4}, {.2, 2.68, 3.6}, false));
    add("cove without a shelf", furnished().level(.02, .5, .12, 3.5, 2.7, true, lamp));
    add("strip under a cabinet", furnished()
                                     .box({.01, 1.8, .5}, {.4, 2.5, 3.5}, false)
                                     .level(.1, .6, .2, 3.4, 1.79, false, lamp));
    for (const bool out : {true, false}) {
        const std::string side = out ? " facing outwards" : " facing inwards";
        const auto name = [&](const char* what) { return what + side; };
        const auto hung = [&] { return furnished().bulb({2, 2, 2}, .05); };
        list.push_back({name("shade, a ring"), hung().ring({2, 1.8, 2}, .3, .4, out).take()});
        list.push_back({name("shade, deep"), hung().ring({2, 1.4, 2}, .2, 1, out).take()});
        list.push_back({name("shade, closed above"),
                        hung().turned({2, 1.8, 2}, {{.3, 0}, {.3, .4}, {.01, .4}}, out).take()});
        list.push_back(
            {name("shade, a cone"), hung().turned({2, 1.8, 2}, {{.4, 0}, {.1, .5}}, out).take()});
        list.push_back({name("shade, a bowl that opens upwards"),
                        hung().turned({2, 1.8, 2}, {{.01, 0}, {.3, 0}, {.3, .4}}, out).take()});
        list.push_back({name("shade around a sheet that shines down"),
                        furnished()
                            .lamp_at(2, 2, 2.1, .15, false)
                            .turned({2, 1.8, 2}, {{.3, 0}, {.3, .4}, {.01, .4}}, out)
                            .take()});
        list.push_back({name("torch, a sheet that shines up in a bowl"),
                        furnished()
                            .lamp_at(2, 2, 1.9, .1, true)
                            .turned({2, 1.8, 2}, {{.01, 0}, {.3, .0}, {.3, .4}}, out)
                            .take()});
        list.push_back({name("a shelf, five sheets"), [&] {
                            Builder b = furnished().lamp_at(2, 2, 2.95, .4, false);
                            for (int k = 1; k <= 5; ++k)
                                b.level(2, .1, 3.5, .4, .4 * k, out);
                            return b.take();
                        }()});
        list.push_back({name("a blind of slats"), [&] {
                            Builder b = furnished().lamp_at(1, 2, 2.9, .4, false);
                            for (int k = 0; k < 10; ++k)
                                b.upright(.5 + .2 * k, 1, .6 + .2 * k, 3, 2.2, out);
                            return b.take();
                        }()});
        list.push_back(
            {name("a screen of one sheet"),
             furnished().lamp_at(1, 2, 2.9, .4, false).upright(0.01, 1, 2, 3, 2.2, out).take()});
        list.push_back(
            {name("a canopy above a lamp"),
             furnished().level(1, 1, 3, 3, 2.5, out).lamp_at(2, 2, 2.3, .2, false).take()});
    }
    add("a wall of two faces in one place", furnished()
                                                .lamp_at(1, 2, 2.95, .4, false)
                                                .upright(0, 1, 2, 3, 2, true)
                                                .upright(0, 1, 2, 3, 2, false));
    add("a thin wall of two faces", furnished()
                                        .lamp_at(1, 2, 2.95, .4, false)
                                        .upright(0, 1, 2, 3, 2, true)
                                        .upright(0, 1, 2, 3, 1.99, false));
    add("rug and pictures", furnished()
                                .lamp_at(2, 2, 2.95, .4, false)
                                .level(1, 1, 3, 3, .01, true)
                                .upright(1, 1, 2, 2, .01, true)
                                .upright(1, 1, 2, 2, 3.99, false));
    add("nested boxes", furnished()
                            .lamp_at(2, 2, 2.95, .4, false)
                            .box({.3, 1, .3}, {1, 2, 1}, false)
                            .box({.4, 1.1, .4}, {.9, 1.9, .9}, true)
                            .box({.5, 1.2, .5}, {.8, 1.5, .8}, false));
    add("a lit box in a dark room",
        furnished().box({1, 1, 1}, {2, 2, 2}, true).bulb({1.5, 1.5, 1.5}, .1));
    add("a lit box in a lit room", furnished()
                                       .lamp_at(3, 3, 2.95, .4, false)
                                       .box({.9, .9, .9}, {2.1, 2.1, 2.1}, false)
                                       .box({1, 1, 1}, {2, 2, 2}, true)
                                       .bulb({1.5, 1.5, 1.5}, .1));
    add("a dark room beside a lit one",
        furnished().lamp_at(2, 2, 2.95, .4, false).box({4.2, 0, 0}, {8, 3, 4}, true, wall));
    add("a room without its front",
        Builder().room(1 << 5).furniture().lamp_at(2, 2, 2.95, .4, false));
    add("a room without ceiling", Builder().room(1 << 1).furniture().lamp_at(2, 2, 4, 1, false));
    add("a window, lit from within", Builder()
                                         .box({0, 0, 0}, {4, 3, 4}, true, wall, 1 << 3)
                                         .holed(4, false)
                                         .furniture()
                                         .lamp_at(2, 2, 2.95, .4, false));
    add("a window, lit from without", Builder()
                                          .box({0, 0, 0}, {4, 3, 4}, true, wall, 1 << 3)
                                          .holed(4, false)
                                          .furniture()
                                          .upright(0, 1, 3, 3, 6, false, lamp));
    add("a skylight", Builder()
                          .box({0, 0, 0}, {4, 3, 4}, true, wall, 1 << 1)
                          .level(0, 0, 4, 1.5, 3, false, wall)
                          .level(0, 2.5, 4, 4, 3, false, wall)
                          .level(0, 1.5, 4, 2.5, 3.2, false, lamp)
                          .furniture());
    add("a ceiling that emits", Builder()
                                    .box({0, 0, 0}, {4, 3, 4}, true, wall, 2)
                                    .level(0, 0, 4, 4, 3, false, lamp)
                                    .furniture());
    add("a furnace", Builder().box({0, 0, 0}, {1, 1, 1}, true, lamp));
    add("two sheets that meet back to front", furnished()
                                                  .lamp_at(1, 2, 2.9, .4, false)
                                                  .upright(.01, 1, 2, 2, 2.2, true)
                                                  .upright(.01, 2, 2, 3, 2.2, false));
    add("a folded screen", furnished()
                               .lamp_at(1, 2, 2.9, .4, false)
                               .upright(.01, 1, 2, 2, 2.2, false)
                               .sheet({2.2, .01, 2}, {2.2, 2, 2}, {3.2, 2, 2}, {3.2, .01, 2}));
    list.push_back({"mirrored rooms", mirrored(furnished().lamp_at(2, 2, 2.95, .4, false).take())});
    list.push_back({"sheets that stand as they like", [&] {
                        Rng rng(5);
                        Builder b = furnished().lamp_at(2, 2, 2.95, .4, false);
                        for (int k = 0; k < 40; ++k) {
                            const Vec3 p(.3 + 3.2 * rng.uniform(), .3 + 2.2 * rng.uniform(),
                                         .3 + 3.2 * rng.uniform());
                            const Vec3 u = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - .5,
                                       v = Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - .5;
                            b.sheet(p, p + .4 * u, p + .4 * (u + v), p + .4 * v);
                        }
                        return b.take();
                    }()});
}

void add_outdoors(std::vector<SidedScene>& list) {
    const auto add = [&](const char* name, const Builder& b) { list.push_back({name, b.take()}); };
    const auto grounds = [] { return Builder().ground().things_outdoors(); };
    const auto house = [](Builder b) {
        b.box({0, 0, 0}, {4, 3, 4}, true, wall, 1 << 3).holed(4, false);
        b.box({-.2, -.1, -.2}, {4.2, 3.2, 4.2}, false, clay, 1 << 3);
        b.holed(4.2, true, clay, -.1, 3.2, -.2, 4.2);
        // The reveal of the window.
        b.sheet({4, 1, 1.5}, {4, 1, 2.5}, {4.2, 1, 2.5}, {4.2, 1, 1.5});
        b.sheet({4, 2, 1.5}, {4.2, 2, 1.5}, {4.2, 2, 2.5}, {4, 2, 2.5});
        b.sheet({4, 1, 1.5}, {4.2, 1, 1.5}, {4.2, 2, 1.5}, {4, 2, 1.5});
        b.sheet({4, 1, 2.5}, {4, 2, 2.5}, {4.2, 2, 2.5}, {4.2, 1, 2.5});
        return b;
    };
    add("open ground", grounds().lamp_at(0, 0, 6, 2, false));
    add("a far sun", grounds().lamp_at(0, 0, 1000, 50, false));
    add("a low sun", grounds().upright(10, -10, 30, 10, 100, false, lamp));
    add("a bulb over ground", grounds().bulb({0, 4, 0}, .2));
    add("a street lamp under a hood",
        grounds().lamp_at(0, 0, 4, .2, false).box({-.3, 3.9, -.3}, {.3, 4.2, .3}, false, clay, 1));
    add("a street lamp under a sheet",
        grounds().lamp_at(0, 0, 4, .2, false).level(-1, -1, 1, 1, 4.02, true));
    add("a pavilion lit from below", grounds().level(-4, -4, 4, 4, 3, true).bulb({0, 2, 0}, .1));
    add("a pavilion lit from above",
        grounds().level(-4, -4, 4, 4, 3, true).lamp_at(0, 0, 9, 2, false));
    add("a sign", grounds().upright(3, -1, 4, 1, -5, true, lamp).upright(3, -1, 4, 1, -5.1, false));
    add("a lamp on a roof that shines to the sky",
        grounds().lamp_at(-2, -2, 2.02, .3, true).lamp_at(0, 0, 9, 1, false));
    add("a lamp on the ground that shines to the sky",
        grounds().lamp_at(8, -8, .02, .3, true).lamp_at(0, 0, 9, 1, false));
    add("a sign on a wall, to the open",
        grounds().upright(.5, -2.5, 1.5, -1.5, -3.02, false, lamp).lamp_at(0, 0, 9, 1, false));
    add("a house, sun above", house(grounds()).lamp_at(8, 2, 9, 2, false));
    add("a house, lamps in and out",
        house(grounds()).lamp_at(8, 2, 9, 2, false).lamp_at(2, 2, 2.95, .3, false));
    add("a house with a closed dark room", Builder()
                                               .ground()
                                               .box({-3, .01, -3}, {3, 3, 3}, false)
                                               .box({-2.8, .2, -2.8}, {2.8, 2.8, 2.8}, true, wall)
                                               .lamp_at(0, 0, 9, 2, false));
    add("a house with a closed lit room", Builder()
                                              .ground()
                                              .box({-3, .01, -3}, {3, 3, 3}, false)
                                              .box({-2.8, .2, -2.8}, {2.8, 2.8, 2.8}, true, wall)
                                              .lamp_at(0, 0, 2.7, .5, false)
                                              .lamp_at(6, 0, 9, 2, false));
    add("a dome of light",
        grounds().turned({0, -.1, 0}, {{12, 0}, {10, 6}, {6, 10}, {.01, 12}}, false, lamp));
    for (const bool towards : {true, false})
        add(towards ? "a billboard lit from its front" : "a billboard lit from behind",
            grounds().upright(1, -2, 3, 2, 0, towards).upright(1, -1, 3, 1, 6, false, lamp));
    list.push_back({"terrain", [] {
                        Builder b;
                        const auto at = [](int i, int k) {
                            return Vec3(i, std::sin(.9 * i) * std::cos(.7 * k), k);
                        };
                        for (int i = -8; i < 8; ++i)
                            for (int k = -8; k < 8; ++k)
                                b.sheet(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k),
                                        wall);
                        return b.lamp_at(0, 0, 6, 1, false).box({0, 1, 0}, {1, 2, 1}, false).take();
                    }()});
    list.push_back({"trees of crossing sheets", [&] {
                        Builder b = Builder().ground();
                        for (int k = -3; k <= 3; ++k) {
                            const double x = 2.5 * k;
                            b.upright(0, -1, 2, 1, x, true);
                            b.sheet({x - 1, 0, 0}, {x + 1, 0, 0}, {x + 1, 2, 0}, {x - 1, 2, 0});
                        }
                        return b.lamp_at(8, 5, 6, 1, false).take();
                    }()});
}

} // namespace

std::vector<SidedScene> sided_scenes() {
    std::vector<SidedScene> list;
    add_rooms(list);
    add_outdoors(list);
    return list;
}

} // namespace hemilux::test
