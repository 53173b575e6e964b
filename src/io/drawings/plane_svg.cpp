#include "io/drawings/plane_svg.h"

#include "io/drawings/canvas.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hemilux {

namespace {

constexpr Colour faint{150, 150, 150}, red{190, 30, 30};
constexpr int width = 1280, height = 790;
constexpr Vec2 ground{640, 700};
/// The room for the scene about the patch, and the radius of the half circle [pixels].
constexpr Vec2 space{590, 620};
constexpr double circle = 220;

/// Returns the segment in which the plane y = 0 cuts a polygon, whose corners are in the frame of
/// the hemisphere.
std::optional<PlaneSection> cut(const std::vector<Vec3>& corner) {
    std::vector<Vec2> ends;
    for (std::size_t k = 0; k < corner.size(); ++k) {
        const Vec3 &a = corner[k], &b = corner[(k + 1) % corner.size()];
        if ((a.y > 0) != (b.y > 0)) {
            const Vec3 p = glm::mix(a, b, a.y / (a.y - b.y));
            ends.emplace_back(p.x, p.z);
        }
    }
    if (ends.size() != 2)
        return std::nullopt;
    return PlaneSection{{ends[0], ends[1]}, false};
}

/// Returns the part of a section that lies at z >= 0.
std::optional<PlaneSection> above(PlaneSection section) {
    constexpr double rounding = 1e-9;
    auto& [a, b] = section.end;
    if (a.y < -rounding && b.y < -rounding)
        return std::nullopt;
    const auto raise = [](Vec2& low, const Vec2& other) {
        if (low.y < -rounding)
            low = glm::mix(low, other, low.y / (low.y - other.y));
    };
    raise(a, b);
    raise(b, a);
    return section;
}

} // namespace

std::vector<PlaneSection> cut_by_plane(const Mesh& mesh, std::uint32_t patch, const Vec3& centre) {
    const Frame frame = mesh.hemisphere_frame(patch);
    std::vector<PlaneSection> sections;
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        if (mesh.material(i).is_far)
            continue;
        std::vector<Vec3> corners;
        for (const Vec3& corner : mesh.patches()[i].shape.corner)
            corners.push_back(frame.to_local(corner - centre));
        if (const auto section = cut(corners))
            if (auto seen = above(*section)) {
                seen->own = i == patch;
                sections.push_back(*seen);
            }
    }
    return sections;
}

std::string plane_svg(const PlaneDrawing& drawing) {
    SvgCanvas canvas(width, height);
    Vec2 reach(1e-9);
    for (const PlaneSection& section : drawing.sections)
        for (const Vec2& end : section.end)
            reach = glm::max(reach, glm::abs(end));
    const double scale = std::min(space.x / reach.x, space.y / reach.y);
    const auto place = [&](const Vec2& p) { return ground + scale * Vec2(p.x, -p.y); };
    canvas.text({40, 30}, drawing.title, {.size = 17, .colour = ink});
    canvas.text({width / 2.0, 760},
                "surfaces along each ray; P3 divides the arc P1 P2 so that P3P1 / P2P3 = "
                "ns(P2) / ns(P1)",
                {.anchor = Anchor::middle, .size = 14, .colour = ink});

    for (const CountedDirection& count : drawing.counts) {
        if (count.direction.y != 0)
            continue;
        const Vec2 way(count.direction.x, -count.direction.z);
        const double end = std::min(space.x / std::max(std::abs(way.x), 1e-9),
                                    space.y / std::max(std::abs(way.y), 1e-9));
        const std::array<Vec2, 2> inner{ground, ground + circle * way},
            outer{ground + circle * way, ground + end * way};
        canvas.line(inner, {.colour = ray_blue, .width = 1.2});
        canvas.line(outer, {.colour = ray_blue, .width = .5, .dash = 4});
        canvas.text(ground + (circle + 14) * way + Vec2(0, 4),
                    std::to_string(static_cast<int>(count.surfaces)),
                    {.anchor = Anchor::middle, .size = 12, .colour = ink});
    }
    std::vector<Vec2> arc;
    constexpr int steps = 64;
    for (int k = 0; k <= steps; ++k) {
        const double angle = std::numbers::pi * k / steps;
        arc.push_back(ground + circle * Vec2(std::cos(angle), -std::sin(angle)));
    }
    canvas.line(arc, {.colour = faint, .width = 1.2});
    for (const PlaneSection& section : drawing.sections) {
        const std::array<Vec2, 2> line{place(section.end[0]), place(section.end[1])};
        canvas.line(line, {.colour = section.own ? red : ink, .width = section.own ? 4.0 : 2.0});
    }
    return canvas.document();
}

} // namespace hemilux
