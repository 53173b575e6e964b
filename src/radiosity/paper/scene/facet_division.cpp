#include "radiosity/paper/scene/facet_division.h"

#include "geometry/numeric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace hemilux {
namespace {

/// Returns the number of pieces no longer than `max_edge` into which a length is cut. A rounding
/// error adds no piece.
std::uint32_t pieces_of(double length, double max_edge) {
    constexpr double slack = 1e-9;
    const double n = std::ceil(length / max_edge - slack);
    return n < 1 ? 1 : static_cast<std::uint32_t>(std::min(n, 1e9));
}

/// Returns which of n pieces holds a coordinate in [0,1] that may be outside by a rounding error;
/// NaN gives 0.
std::uint32_t piece_at(double x, std::uint32_t n) {
    const double i = std::floor(x * n);
    return i > 0 ? static_cast<std::uint32_t>(std::min(i, n - 1.0)) : 0;
}

/// Divides a triangle into rows from the apex a on; ab and ac lead to the next row.
void divide_similar(const Vec3& a, const Vec3& ab, const Vec3& ac, std::uint32_t n,
                    std::vector<Polygon>& made) {
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        return a + double(i) * ab + double(j) * ac;
    };
    for (std::uint32_t k = 0; k < n; ++k)
        for (std::uint32_t j = 0; j <= k; ++j) {
            const std::uint32_t i = k - j;
            made.push_back({{point(i, j), point(i + 1, j), point(i, j + 1), point(i, j + 1)}});
            if (i > 0)
                made.push_back(
                    {{point(i, j), point(i, j + 1), point(i - 1, j + 1), point(i - 1, j + 1)}});
        }
}

/// Divides a triangle into n strips from the apex a to the opposite edge, with m columns each. The
/// first strip consists of triangles.
void divide_fan(const Vec3& a, const Vec3& ab, const Vec3& ac, std::uint32_t n, std::uint32_t m,
                std::vector<Polygon>& made) {
    const auto point = [&](std::uint32_t k, std::uint32_t j) {
        const double r = double(k) / n, w = double(j) / m;
        return a + r * ((1 - w) * ab + w * ac);
    };
    for (std::uint32_t k = 0; k < n; ++k)
        for (std::uint32_t j = 0; j < m; ++j) {
            const Vec3 left = point(k + 1, j), right = point(k + 1, j + 1);
            if (k == 0)
                made.push_back({{a, left, right, right}});
            else
                made.push_back({{point(k, j), left, right, point(k, j + 1)}});
        }
}

} // namespace

FacetDivision::FacetDivision(const Polygon& shape, double max_edge, std::size_t most)
    : triangle_(shape.is_triangle()) {
    if (triangle_)
        divide_triangle(shape, max_edge);
    else
        divide_quad(shape, max_edge);
    if (!(double(rows_) * (similar_ ? rows_ : columns_) <= static_cast<double>(most)))
        throw std::invalid_argument("the division of faces makes too many patches; choose a larger "
                                    "maximal edge length");
}

void FacetDivision::divide_quad(const Polygon& shape, double max_edge) {
    const auto& p = shape.corner;
    const auto longer = [](const Vec3& a, const Vec3& b) {
        return std::max(glm::length(a), glm::length(b));
    };
    columns_ = pieces_of(longer(p[1] - p[0], p[2] - p[3]), max_edge);
    rows_ = pieces_of(longer(p[3] - p[0], p[2] - p[1]), max_edge);

    // Here g = ga e1 + gb e3 in the quad's plane; e1 and e3 are the edges at corner 0.
    const Vec3 e1 = p[1] - p[0], e3 = p[3] - p[0], g = p[0] - p[1] + p[2] - p[3];
    const double a = glm::dot(e1, e1), b = glm::dot(e1, e3), c = glm::dot(e3, e3);
    const double g1 = glm::dot(g, e1), g3 = glm::dot(g, e3), determinant = a * c - b * b;
    if (determinant > 0) {
        g_x_ = (g1 * c - g3 * b) / determinant;
        g_y_ = (g3 * a - g1 * b) / determinant;
    }
}

void FacetDivision::divide_triangle(const Polygon& shape, double max_edge) {
    const auto opposite = [&](std::size_t i) {
        return glm::length(shape.corner[(i + 2) % 3] - shape.corner[(i + 1) % 3]);
    };
    std::size_t apex = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (opposite(i) < opposite(apex))
            apex = i;
    rows_ = pieces_of(std::max(opposite((apex + 1) % 3), opposite((apex + 2) % 3)), max_edge);
    columns_ = pieces_of(opposite(apex), max_edge);
    similar_ = 2 * columns_ >= rows_;
    if (rows_ > 1) // else the piece is the facet, with its corners in their order
        apex_ = static_cast<std::uint8_t>(apex);
}

std::vector<Polygon> FacetDivision::cut(const Polygon& shape) const {
    if (pieces() == 1)
        return {shape};
    if (!triangle_)
        return cut_quad(shape);
    std::vector<Polygon> made;
    const Vec3 a = shape.corner[apex_];
    const Vec3 ab = shape.corner[(apex_ + 1u) % 3] - a, ac = shape.corner[(apex_ + 2u) % 3] - a;
    if (similar_)
        divide_similar(a, ab / double(rows_), ac / double(rows_), rows_, made);
    else
        divide_fan(a, ab, ac, rows_, columns_, made);
    return made;
}

std::vector<Polygon> FacetDivision::cut_quad(const Polygon& shape) const {
    const auto& p = shape.corner;
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        const double s = double(i) / columns_, t = double(j) / rows_;
        return (1 - t) * ((1 - s) * p[0] + s * p[1]) + t * ((1 - s) * p[3] + s * p[2]);
    };
    std::vector<Polygon> made;
    for (std::uint32_t j = 0; j < rows_; ++j)
        for (std::uint32_t i = 0; i < columns_; ++i)
            made.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)}});
    return made;
}

FacetDivision::Place FacetDivision::place_in_quad(const Hit& hit) const {
    // The point is corner0 + x e1 + y e3; corner 2 lies at (1 + g_x, 1 + g_y).
    const double to_corner2 = hit.second_half ? hit.u : hit.v;
    const double x = to_corner2 * (1 + g_x_) + (hit.second_half ? 0 : hit.u);
    const double y = to_corner2 * (1 + g_y_) + (hit.second_half ? hit.v : 0);
    // The map is bilinear: x = s + s t g_x, y = t + s t g_y. Eliminating s leaves a quadratic in t.
    const double b = 1 + x * g_y_ - y * g_x_;
    const double t = 2 * y / (b + safe_sqrt(b * b + 4 * g_x_ * y));
    const double s = x / (1 + t * g_x_);
    const std::uint32_t row = piece_at(t, rows_), column = piece_at(s, columns_);
    return {row * columns_ + column, {s * columns_ - column, t * rows_ - row}};
}

FacetDivision::Place FacetDivision::place_in_triangle(const Hit& hit) const {
    const std::array<double, 3> weight{1 - hit.u - hit.v, hit.u, hit.v};
    const double b = weight[(apex_ + 1u) % 3], c = weight[(apex_ + 2u) % 3];
    const std::uint32_t k = piece_at(b + c, rows_);
    if (!similar_) {
        const double across = c / (b + c);
        const std::uint32_t column = piece_at(across, columns_);
        return {k * columns_ + column, {(b + c) * rows_ - k, across * columns_ - column}};
    }
    // Row k holds k + 1 upright triangles and between them k that are upside down.
    const std::uint32_t across = std::min(k, piece_at(c, rows_));
    const bool upside_down = across < k && std::floor(b * rows_) + across < k;
    // Coordinates count from the corner from which all rows count.
    const double to_b = b * rows_ - (k - across), to_c = c * rows_ - across;
    return {k * k + 2 * across + (upside_down ? 1 : 0),
            upside_down ? Vec2(to_b + to_c, -to_b) : Vec2(to_b, to_c)};
}

} // namespace hemilux
