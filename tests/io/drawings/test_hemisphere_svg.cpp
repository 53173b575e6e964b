// Drawings of divided hemispheres, and the colours of densities.
#include "io/drawings/colour_bar.h"
#include "io/drawings/density_picture.h"
#include "io/drawings/hemisphere_svg.h"
#include "parallel/workers.h"
#include "radiosity/engine/densities/density.h"
#include "radiosity/paper/hemisphere/density_direction.h"
#include "support/catch.h"
#include "support/scenes.h"
#include "support/solve.h"

#include <cmath>
#include <numbers>

using namespace hemilux;

namespace {

/// Keeps what is drawn on it.
class Record final : public Canvas {
  public:
    void polygon(std::span<const Vec2> corners, Colour fill, double) override {
        polygons.push_back({{corners.begin(), corners.end()}, fill});
    }
    void line(std::span<const Vec2> points, const Stroke&) override {
        lines.emplace_back(points.begin(), points.end());
    }
    void text(const Vec2&, std::string_view text, const TextStyle&) override {
        texts.emplace_back(text);
    }

    struct Filled {
        std::vector<Vec2> corners;
        Colour fill;
    };
    std::vector<Filled> polygons;
    std::vector<std::vector<Vec2>> lines;
    std::vector<std::string> texts;
};

constexpr std::size_t dot_corners = 8, min_triangle_corners = 9;

bool in_circle(const Vec2& point, const Vec2& centre) {
    return glm::length(point - centre) <= dome_radius * (1 + 1e-9);
}

/// Triangles of the view around a centre.
std::vector<Record::Filled> triangles(const Record& record, const Vec2& centre) {
    std::vector<Record::Filled> result;
    for (const Record::Filled& polygon : record.polygons)
        if (polygon.corners.size() >= min_triangle_corners &&
            glm::length(polygon.corners.front() - centre) < 1.01 * dome_radius)
            result.push_back(polygon);
    return result;
}

double area(const std::vector<Vec2>& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec2 &a = p[i], &b = p[(i + 1) % p.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

struct Example {
    test::Model model{test::room_with_block()};
    Hemisphere hemisphere;
    Monitor monitor;
    DensityMap map;
    std::vector<DensityLeaf> leaves;
    std::vector<DensityCount> counts;

    Example(int depth, double threshold, std::uint32_t patch)
        : hemisphere(depth),
          map(model.mesh, model.bvh, hemisphere, threshold, Workers(1), monitor) {
        map.leaves(patch, leaves);
        map.counts(patch, counts);
    }
    [[nodiscard]] HemisphereDrawing drawing() const {
        HemisphereDrawing result{"a <patch> & its hemisphere", {}, {}};
        for (const DensityLeaf& leaf : leaves)
            result.triangles.push_back({hemisphere.cells()[leaf.cell].shape, leaf.density});
        for (const DensityCount& count : counts)
            result.counts.push_back(
                {hemisphere.vertices()[count.vertex], static_cast<double>(count.surfaces)});
        return result;
    }
};

/// Every tag is closed in its turn, every attribute quoted, no stray < or &.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find_first_of("<>", at + 1);
        if (end == std::string::npos || xml[end] != '>')
            return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (std::ranges::count(tag, '"') % 2 != 0)
            return false;
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.front() == '/') {
            if (open.empty() || "/" + open.back() != tag)
                return false;
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
    }
    for (std::size_t at = xml.find('&'); at != std::string::npos; at = xml.find('&', at + 1))
        if (xml.compare(at, 5, "&amp;") != 0 && xml.compare(at, 4, "&lt;") != 0)
            return false;
    return open.empty();
}

} // namespace

TEST_CASE("Each triangle of a hemisphere is drawn once from above") {
    for (const int depth : {0, 1, 2, 3, 5})
        for (const double threshold : {0.0, 1.5, 1e9}) {
            const Example example(depth, threshold, 7);
            Record record;
            draw(example.drawing(), record);
            CAPTURE(depth, threshold);
            const auto drawn = triangles(record, centre_above);
            CHECK(drawn.size() == example.leaves.size());
            double sum = 0;
            for (const Record::Filled& polygon : drawn)
                sum += area(polygon.corners);
            CHECK(sum / (dome_radius * dome_radius) == Approx(std::numbers::pi).epsilon(.004));
        }
}

TEST_CASE("The side view covers the outline of a dome") {
    const Example example(2, 0, 7);
    Record record;
    draw(example.drawing(), record);
    const auto drawn = triangles(record, centre_side);
    CHECK(drawn.size() < example.leaves.size());
    CHECK(drawn.size() > example.leaves.size() / 3);
    double sum = 0;
    for (const Record::Filled& polygon : drawn)
        sum += area(polygon.corners);
    // Half a circle above, half an ellipse below, at 20 degrees.
    const double expected = std::numbers::pi / 2 * (1 + std::sin(std::numbers::pi / 9));
    CHECK(sum / (dome_radius * dome_radius) == Approx(expected).epsilon(.01));
}

TEST_CASE("All arcs stay within the unit circle and are curved") {
    const Example example(3, 0, 11);
    Record record;
    draw(example.drawing(), record);
    for (const Vec2& centre : {centre_above, centre_side})
        for (const Record::Filled& polygon : triangles(record, centre))
            for (const Vec2& point : polygon.corners)
                REQUIRE(in_circle(point, centre));
    const Example coarse(0, 0, 11);
    Record roots;
    draw(coarse.drawing(), roots);
    double farthest = 0; // of a root's points: the horizon is a circle, not a chord
    for (const Record::Filled& polygon : triangles(roots, centre_above)) {
        std::size_t on_circle = 0;
        for (const Vec2& point : polygon.corners) {
            const double radius = glm::length(point - centre_above) / dome_radius;
            farthest = std::max(farthest, radius);
            on_circle += radius > 1 - 1e-9;
        }
        CHECK(on_circle > 10);
    }
    CHECK(farthest == Approx(1));
}

TEST_CASE("Dots are labelled with what the density rays counted") {
    const Example example(2, 0, 7);
    REQUIRE(example.counts.size() == 41);
    Record record;
    draw(example.drawing(), record);
    std::size_t dots = 0;
    for (const Record::Filled& polygon : record.polygons) {
        const Vec2 middle =
            (polygon.corners[0] + polygon.corners[polygon.corners.size() / 2]) / 2.0;
        dots += polygon.corners.size() == dot_corners && in_circle(middle, centre_above);
    }
    CHECK(dots == 41);
    const Mesh& mesh = example.model.mesh;
    const Frame frame = mesh.hemisphere_frame(7);
    for (const DensityCount& count : example.counts) {
        Ray ray{mesh.patches()[7].centre,
                frame.to_world(density_direction(example.hemisphere.vertices()[count.vertex]))};
        ray.from = mesh.patches()[7].facet;
        CHECK(count.surfaces == example.model.bvh.count(ray));
        CHECK(std::ranges::count(record.texts, std::to_string(count.surfaces)) > 0);
    }
}

TEST_CASE("Energy rays are drawn inside the circle") {
    const Example example(2, 0, 7);
    const std::vector<Vec3> rays{{0, 0, 1}, {.6, 0, .8}, {0, -.8, .6}};
    HemisphereDrawing drawing = example.drawing();
    Record without, with;
    draw(drawing, without);
    drawing.rays = rays;
    draw(drawing, with);
    CHECK(with.polygons.size() ==
          without.polygons.size() + 2 * rays.size()); // each with a pale rim
}

TEST_CASE("The drawing is well-formed XML") {
    CHECK_FALSE(is_well_formed("<svg><text></svg>"));
    CHECK_FALSE(is_well_formed("<svg a=\"></svg>"));
    CHECK_FALSE(is_well_formed("<svg>a & b</svg>"));
    for (const int depth : {0, 2, 5}) {
        const Example example(depth, 0, 3);
        const std::string text = hemisphere_svg(example.drawing());
        CHECK(is_well_formed(text));
        CHECK(text.find("nan") == std::string::npos);
        CHECK(text.find("a &lt;patch> &amp; its hemisphere") != std::string::npos);
    }
}

TEST_CASE("A patch that sees nothing has a drawing") {
    const Hemisphere hemisphere(0);
    HemisphereDrawing drawing{"nothing", {}, {}};
    for (const Hemisphere::Cell& cell : hemisphere.cells())
        drawing.triangles.push_back({cell.shape, 0});
    for (const Vec3& vertex : hemisphere.vertices())
        drawing.counts.push_back({vertex, 0});
    const std::string text = hemisphere_svg(drawing);
    CHECK(is_well_formed(text));
    CHECK(text.find("nan") == std::string::npos);
}

TEST_CASE("The hemispheres of parts stand apart from each other on the patch") {
    const Example example(1, 0, 7);
    HemisphereDrawing drawing = example.drawing();
    const Polygon square{{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 3, 0), Vec3(0, 3, 0)}};
    for (std::size_t part = 0; part < 4; ++part)
        drawing.parts.push_back({part_of(square, 4, part), drawing.triangles});
    Record record;
    draw(drawing, record);
    CHECK(triangles(record, centre_above).size() == 16);
    const auto drawn = triangles(record, centre_side);
    double sum = 0;
    for (const Record::Filled& polygon : drawn) {
        sum += area(polygon.corners);
        for (const Vec2& point : polygon.corners)
            REQUIRE(in_circle(point, centre_side));
    }
    // Four domes; each of .4 times the root of its quarter's area over half of the diagonal.
    const double radius = .4 * 1.5 / (1.5 * std::sqrt(2.0));
    const double expected =
        4 * radius * radius * std::numbers::pi / 2 * (1 + std::sin(std::numbers::pi / 9));
    CHECK(sum / (dome_radius * dome_radius) == Approx(expected).epsilon(.02));
    CHECK(is_well_formed(hemisphere_svg(drawing)));
}

TEST_CASE("Heat colours grow darker") {
    const auto lightness = [](double t) {
        const Colour c = heat_colour(t);
        return .2126 * c.r + .7152 * c.g + .0722 * c.b;
    };
    for (int i = 0; i < 50; ++i)
        CHECK(lightness(i / 50.0) > lightness((i + 1) / 50.0));
    CHECK(lightness(-1) == lightness(0));
    CHECK(lightness(7) == lightness(1));
}

TEST_CASE("A picture of numbers shows each patch in its colour, the sky in white") {
    test::Model model(test::open_scene());
    std::vector<double> numbers(model.mesh.patches().size(), 2.0);
    numbers.back() = 4; // the lamp, which looks down
    const Camera below{.eye = {0, .2, 0}, .target = {0, 1.6, 0}, .up = {0, 0, 1}};
    const Image image = density_picture(model.mesh, model.bvh, numbers, "numbers", below,
                                        {.width = 60, .height = 60, .samples = 1, .threads = 1});
    CHECK(image.width == 60);
    CHECK(image.height > 60);
    CHECK(image.at(30, 30).r == Approx(linear_from_srgb(float(heat_colour(1).r) / 255)));
    CHECK(image.at(1, 1) == glm::vec3(1));
}
