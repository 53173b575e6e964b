#include "io/drawings/hemisphere_svg.h"

#include "io/drawings/colour_bar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace hemilux {

namespace {

constexpr Colour edge_ink{90, 90, 90}, white{255, 255, 255};
constexpr double side_elevation = 20, side_azimuth = 28; // degrees
constexpr std::size_t max_labels = 150;                  // the vertices of depth 3 fit
constexpr double label_size = 14, title_size = 17;

/// A parallel projection of the unit sphere.
struct DomeView {
    Vec2 centre;
    Vec3 right, up, toward; ///< the last to the viewer
    double radius = dome_radius;

    [[nodiscard]] Vec2 place(const Vec3& d) const {
        return centre + radius * Vec2(glm::dot(d, right), -glm::dot(d, up));
    }
    [[nodiscard]] bool sees(const Vec3& d) const {
        constexpr double rounding = 1e-12;
        return glm::dot(d, toward) >= -rounding;
    }
};

DomeView from_above() { return {centre_above, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

DomeView from_side() {
    constexpr double radian = std::numbers::pi / 180;
    const double a = side_azimuth * radian, e = side_elevation * radian;
    const Vec3 toward(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
    const Vec3 right(-std::sin(a), std::cos(a), 0);
    return {centre_side, right, glm::cross(toward, right), toward};
}

/// Appends points of the great-circle arc from a on, without b.
void append_arc(const Vec3& a, const Vec3& b, int steps, std::vector<Vec3>& points) {
    for (int i = 0; i < steps; ++i)
        points.push_back(glm::normalize(glm::mix(a, b, double(i) / steps)));
}

std::vector<Vec3> outline_of(const SphericalTriangle& triangle) {
    constexpr double steps_per_radian = 48 / std::numbers::pi;
    const auto& v = triangle.vertices();
    std::vector<Vec3> outline;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = v[i], &b = v[(i + 1) % 3];
        const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        append_arc(a, b, std::max(4, static_cast<int>(steps_per_radian * angle)), outline);
    }
    return outline;
}

/// Returns the part of a triangle's outline that is turned to the viewer, closed along the
/// silhouette.
std::vector<Vec3> seen_part(const std::vector<Vec3>& outline, const DomeView& view) {
    std::vector<Vec3> part;
    std::size_t exit = outline.size(); // the point of `part` where the outline turns away
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if (view.sees(a))
            part.push_back(a);
        if (view.sees(a) == view.sees(b))
            continue;
        const double height_a = glm::dot(a, view.toward), height_b = glm::dot(b, view.toward);
        if (view.sees(a))
            exit = part.size();
        part.push_back(glm::normalize(glm::mix(a, b, height_a / (height_a - height_b))));
    }
    if (exit >= part.size())
        return part;
    std::vector<Vec3> silhouette;
    append_arc(part[exit], part[(exit + 1) % part.size()], 32, silhouette);
    part.insert(part.begin() + static_cast<std::ptrdiff_t>(exit) + 1, silhouette.begin() + 1,
                silhouette.end());
    return part;
}

std::vector<Vec2> placed(const std::vector<Vec3>& directions, const DomeView& view) {
    std::vector<Vec2> points;
    for (const Vec3& d : directions)
        points.push_back(view.place(d));
    return points;
}

void draw_dot(const Vec2& at, double radius, Colour colour, Canvas& canvas) {
    std::array<Vec2, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle = 2 * std::numbers::pi * (double(i) + 0.5) / double(corners.size());
        corners[i] = at + radius * Vec2(std::cos(angle), std::sin(angle));
    }
    canvas.polygon(corners, colour, 1);
}

void draw_triangles(std::span<const DrawnTriangle> triangles, const DomeView& view, double most,
                    Canvas& canvas) {
    std::vector<std::vector<Vec2>> edges;
    for (const DrawnTriangle& triangle : triangles) {
        std::vector<Vec2> points = placed(seen_part(outline_of(triangle.shape), view), view);
        if (points.size() < 3)
            continue;
        canvas.polygon(points, heat_colour(most > 0 ? triangle.density / most : 0), 1);
        points.push_back(points.front());
        edges.push_back(std::move(points));
    }
    for (const std::vector<Vec2>& edge : edges) // above all fillings
        canvas.line(edge, {.colour = edge_ink, .width = 0.8});
}

/// Draws the patch as large as a dome, and on each part of it a dome that leaves some of the part
/// free. The nearest are drawn last.
void draw_parts(std::span<const HemisphereDrawing::Part> parts, const DomeView& view, double most,
                Canvas& canvas) {
    Vec3 centre(0.0);
    double area = 0, reach = 0;
    for (const auto& part : parts) {
        centre += part.outline.area() * part.outline.centre();
        area += part.outline.area();
    }
    if (!(area > 0)) // nothing to stand on
        return;
    centre /= area;
    for (const auto& part : parts)
        for (const Vec3& corner : part.outline.corner)
            reach = std::max(reach, glm::length(corner - centre));
    std::vector<const HemisphereDrawing::Part*> order;
    for (const auto& part : parts)
        order.push_back(&part);
    std::ranges::stable_sort(order, {}, [&view](const auto* part) {
        return glm::dot(part->outline.centre(), view.toward);
    });
    for (const auto* part : order) {
        std::vector<Vec3> corners;
        for (const Vec3& corner : part->outline.corner)
            corners.push_back((corner - centre) / reach);
        corners.push_back(corners.front());
        canvas.line(placed(corners, view), {.colour = ink, .width = 1.2});
    }
    for (const auto* part : order) {
        DomeView dome = view;
        dome.centre = view.place((part->outline.centre() - centre) / reach);
        dome.radius = 0.4 * dome_radius * std::sqrt(part->outline.area()) / reach;
        draw_triangles(part->triangles, dome, most, canvas);
    }
}

void draw_counts(const HemisphereDrawing& drawing, const DomeView& view, bool labels,
                 Canvas& canvas) {
    const double radius = drawing.counts.size() > max_labels ? 1.2 : 2.6;
    for (const CountedDirection& count : drawing.counts) {
        if (view.sees(count.direction))
            draw_dot(view.place(count.direction), radius, ink, canvas);
    }
    if (!labels || drawing.counts.size() > max_labels)
        return;
    constexpr double size = 11, digit = 6.2;
    for (const CountedDirection& count : drawing.counts) {
        const std::string text = std::to_string(static_cast<int>(count.surfaces));
        const Vec2 at = view.place(count.direction) + Vec2(5, -4);
        fill_box(canvas, at + Vec2(-1, -9), at + Vec2(digit * double(text.size()) + 1, 1), white,
                 0.75);
        canvas.text(at, text, {.size = size, .colour = ink});
    }
}

void draw_rays(std::span<const Vec3> rays, const DomeView& view, Canvas& canvas) {
    const double half = rays.size() > 2000 ? 0.6 : 1.1;
    for (const Vec3& ray : rays) {
        const Vec2 at = view.place(ray);
        fill_box(canvas, at - Vec2(half + 0.5), at + Vec2(half + 0.5), white, 0.7);
        fill_box(canvas, at - Vec2(half), at + Vec2(half), ray_blue);
    }
}

void draw_captions(const HemisphereDrawing& drawing, Canvas& canvas) {
    const TextStyle middle{.anchor = Anchor::middle, .size = label_size, .colour = ink};
    canvas.text({40, 30}, drawing.title, {.size = title_size, .colour = ink});
    canvas.text({centre_above.x, 68}, "from above", middle);
    canvas.text({centre_side.x, 68},
                drawing.parts.empty() ? "from the side" : "over each part of the patch", middle);
    std::string legend = "dots: density rays, with the surfaces counted";
    if (drawing.counts.size() > max_labels)
        legend = "dots: density rays";
    if (drawing.counts.empty())
        legend = "";
    if (!drawing.rays.empty())
        legend += "; blue: " + std::to_string(drawing.rays.size()) +
                  (drawing.rays.size() == 1 ? " energy ray" : " energy rays");
    canvas.text({centre_above.x, 708}, legend, middle);
}

} // namespace

void draw(const HemisphereDrawing& drawing, Canvas& canvas) {
    double most = 0;
    const auto look_at = [&most](std::span<const DrawnTriangle> triangles) {
        for (const DrawnTriangle& triangle : triangles)
            most = std::max(most, triangle.density);
    };
    look_at(drawing.triangles);
    for (const auto& part : drawing.parts)
        look_at(part.triangles);
    draw_captions(drawing, canvas);
    const DomeView above = from_above(), side = from_side();
    draw_triangles(drawing.triangles, above, most, canvas);
    draw_rays(drawing.rays, above, canvas);
    draw_counts(drawing, above, true, canvas);
    if (drawing.parts.empty()) {
        draw_triangles(drawing.triangles, side, most, canvas);
        draw_counts(drawing, side, false, canvas);
    } else {
        draw_parts(drawing.parts, side, most, canvas);
    }
    draw_colour_bar({440, 732}, {840, 746}, most, "density, " + drawing.unit, canvas);
}

std::string hemisphere_svg(const HemisphereDrawing& drawing) {
    SvgCanvas canvas(dome_width, dome_height);
    draw(drawing, canvas);
    return canvas.document();
}

} // namespace hemilux
