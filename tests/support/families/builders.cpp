#include "support/families/builders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hemilux::test {
namespace {

struct BoxFrame {
    Vec3 corner, first, second; ///< of a side, turning so that its front is inside
};

BoxFrame side_of(const Vec3& low, const Vec3& high, std::uint32_t side) {
    const Vec3 d = high - low, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    const std::array<BoxFrame, 6> sides{
        {{low, z, x}, {low + y, x, z}, {low, y, z}, {low + x, z, y}, {low, x, y}, {low + z, y, x}}};
    return sides.at(side);
}

Polygon inset_of(const Polygon& around, const Vec2& share) {
    Polygon inner = around;
    const Vec3 centre = around.centre();
    for (std::size_t c = 0; c < 4; ++c) {
        if (around.is_triangle()) {
            inner.corner[c] = centre + share.x * (around.corner[c] - centre);
            continue;
        }
        const Vec3 first = .5 * (around.corner[1] - around.corner[0]);
        const Vec3 second = .5 * (around.corner[3] - around.corner[0]);
        inner.corner[c] = centre + (c == 0 || c == 3 ? -share.x : share.x) * first +
                          (c < 2 ? -share.y : share.y) * second;
    }
    return inner;
}

} // namespace

Scene with_materials(std::vector<Material> materials) {
    Scene scene;
    scene.materials = std::move(materials);
    scene.groups = {"default"};
    return scene;
}

Material grey(const char* name, double reflectance, double emission) {
    return {name, Vec3(reflectance), Vec3(emission)};
}

std::uint32_t facets_of(const Scene& scene) {
    return static_cast<std::uint32_t>(scene.facets.size());
}

Polygon parallelogram(const Vec3& corner, const Vec3& first, const Vec3& second) {
    return {{corner, corner + first, corner + first + second, corner + second}};
}

void add_polygon(Scene& scene, const Polygon& polygon, std::uint32_t material) {
    const auto base = static_cast<std::uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), polygon.corner.begin(),
                          polygon.corner.begin() + polygon.size());
    const std::uint32_t last = base + static_cast<std::uint32_t>(polygon.size()) - 1;
    scene.facets.push_back({{base, base + 1, base + 2, last}, scene.faces++, material, 0});
}

Polygon add_with_inset(Scene& scene, const Polygon& around, std::uint32_t material,
                       const Inset& inset) {
    const Polygon inner = inset_of(around, inset.share);
    const auto corners = static_cast<std::size_t>(around.size());
    if (inset.share != Vec2(1.0))
        for (std::size_t a = 0; a < corners; ++a) {
            const std::size_t b = (a + 1) % corners;
            add_polygon(scene,
                        {{around.corner[a], around.corner[b], inner.corner[b], inner.corner[a]}},
                        material);
        }
    if (inset.inner)
        add_polygon(scene, inner, *inset.inner);
    return inner;
}

BuiltBox add_box(Scene& scene, const Vec3& low, const Vec3& high, std::uint32_t n,
                 std::uint32_t material, const std::vector<OddCell>& odd) {
    BuiltBox box;
    box.patches.begin = facets_of(scene);
    for (std::uint32_t side = 0; side < 6; ++side) {
        const auto [corner, first, second] = side_of(low, high, side);
        const auto at = [&, corner = corner, first = first, second = second](std::uint32_t i,
                                                                             std::uint32_t j) {
            return corner + double(i) / n * first + double(j) / n * second;
        };
        for (std::uint32_t j = 0; j < n; ++j)
            for (std::uint32_t i = 0; i < n; ++i) {
                const Polygon cell{{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}};
                const auto found = std::ranges::find_if(odd, [&](const OddCell& o) {
                    return o.side == side && o.column == i && o.row == j;
                });
                if (found == odd.end()) {
                    add_polygon(scene, cell, material);
                    continue;
                }
                const Polygon inner = add_with_inset(scene, cell, material, found->inset);
                if (!found->inset.inner)
                    box.openings.push_back(inner);
            }
    }
    box.patches.end = facets_of(scene);
    return box;
}

std::vector<double> lost_through(const DenseSystem& system, Range range,
                                 const std::vector<Polygon>& openings) {
    std::vector<double> lost(range.end - range.begin);
    for (std::size_t i = range.begin; i < range.end; ++i)
        for (const Polygon& opening : openings)
            lost[i - range.begin] +=
                exchange_in_the_open(system.shape(i), opening) / system.area(i);
    return lost;
}

void add_convex(DenseSystem& system, const BuiltBox& box, ExchangeTable& table) {
    system.add_open_pairs(box.patches, table);
    system.close_rows(box.patches, lost_through(system, box.patches, box.openings));
}

void weld(Scene& scene) {
    std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
    std::vector<Vec3> kept;
    std::vector<std::uint32_t> now;
    for (const Vec3& v : scene.vertices) {
        const auto rounded = [](double x) { return std::llround(x * 1e10); };
        const auto [place, is_new] = known.try_emplace({rounded(v.x), rounded(v.y), rounded(v.z)},
                                                       static_cast<std::uint32_t>(kept.size()));
        if (is_new)
            kept.push_back(v);
        now.push_back(place->second);
    }
    for (Facet& facet : scene.facets)
        for (std::uint32_t& v : facet.vertex)
            v = now[v];
    scene.vertices = std::move(kept);
}

HardScene solved(Scene scene, std::vector<Vec3> reference, double relative_error,
                 std::vector<std::vector<std::uint32_t>> parts) {
    HardScene hard;
    const std::vector<Vec3> emission = emission_of(scene);
    weld(scene);
    hard.scene = std::move(scene);
    for (std::size_t i = 0; i < reference.size(); ++i)
        hard.reference_error.push_back(relative_error * glm::abs(reference[i] - emission[i]));
    hard.reference = std::move(reference);
    hard.parts = std::move(parts);
    return hard;
}

HardScene solved(Scene scene, const DenseSystem& system, double relative_error,
                 std::vector<std::vector<std::uint32_t>> parts) {
    HardScene hard = solved(std::move(scene), system.solve(), relative_error, std::move(parts));
    hard.row_error = system.row_error();
    return hard;
}

std::vector<Vec3> emission_of(const Scene& scene) {
    std::vector<Vec3> emission;
    for (const Facet& facet : scene.facets)
        emission.push_back(scene.materials[facet.material].emission);
    return emission;
}

} // namespace hemilux::test
