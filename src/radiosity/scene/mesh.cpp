#include "radiosity/scene/mesh.h"

#include "geometry/numeric.h"
#include "radiosity/sampling/rng.h"
#include "radiosity/sampling/workers.h"
#include "radiosity/scene/coplanar_layers.h"
#include "radiosity/scene/textured_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace hemilux {
namespace {

/// How many pieces no longer than `max_edge` a length is cut into; a rounding error makes no
/// further one.
std::uint32_t pieces(double length, double max_edge) {
    constexpr double slack = 1e-9;
    const double n = std::ceil(length / max_edge - slack);
    return n < 1 ? 1 : static_cast<std::uint32_t>(std::min(n, 1e9));
}

/// Piece i of n for a coordinate in [0,1] that may be outside by a rounding error; NaN is 0.
std::uint32_t piece_at(double x, std::uint32_t n) {
    const double i = std::floor(x * n);
    return i > 0 ? static_cast<std::uint32_t>(std::min(i, n - 1.0)) : 0;
}

/// Rows from the apex a on; ab and ac lead to the next row.
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

/// n strips from the apex a to the opposite edge, m columns each; the first strip is of triangles.
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

double radius_of(const Patch& patch) {
    double squares = 0;
    for (const Vec3& corner : patch.shape.corner)
        squares = std::max(squares, glm::dot(corner - patch.centre, corner - patch.centre));
    return std::sqrt(squares);
}

/// The centre, and how far corners are from it at most, of the box around all facets. But where
/// most of them lie in a small part of that, as under a distant sun, the centre of that part: there
/// floats are most precise.
LocalFrame LocalFrame::of(const Scene& scene) {
    constexpr double small_part = 1.0 / 1024, left_out = 1.0 / 16; // of the extent; on either side
    LocalFrame frame;
    double most = 0, whole = 0, inner = 0;
    Vec3 centre_of_inner;
    std::array<std::array<double, 2>, 3> ends{};
    std::vector<double> places;
    for (int axis = 0; axis < 3; ++axis) {
        places.clear();
        for (const Facet& facet : scene.facets)
            for (const std::uint32_t v : facet.vertex)
                places.push_back(scene.vertices[v][axis]);
        const auto [low, high] = std::ranges::minmax(places);
        ends.at(static_cast<std::size_t>(axis)) = {low, high};
        const auto skipped = static_cast<std::ptrdiff_t>(left_out * double(places.size()));
        const auto first = places.begin() + skipped, last = places.end() - 1 - skipped;
        std::nth_element(places.begin(), first, places.end());
        std::nth_element(first, last, places.end());
        frame.centre[axis] = .5 * (low + high);
        centre_of_inner[axis] = .5 * (*first + *last);
        whole = std::max(whole, high - low);
        inner = std::max(inner, *last - *first);
    }
    if (inner < small_part * whole)
        frame.centre = centre_of_inner;
    for (int axis = 0; axis < 3; ++axis)
        for (const double end : ends.at(static_cast<std::size_t>(axis)))
            most = std::max(most, std::abs(end - frame.centre[axis]));
    int exponent = 0;
    std::frexp(most, &exponent);
    frame.scale = std::ldexp(1.0, -exponent);
    return frame;
}

std::vector<Vec3> LocalFrame::to_local(std::span<const Vec3> world) const {
    std::vector<Vec3> local;
    local.reserve(world.size());
    for (const Vec3& point : world)
        local.push_back(to_local(point));
    return local;
}

Mesh::Mesh(Scene scene, const MeshOptions& options)
    : scene_(std::move(scene)), two_sided_(options.two_sided) {
    if (scene_.facets.empty())
        throw std::invalid_argument("the scene has no face with an area");
    frame_ = LocalFrame::of(scene_);
    vertices_ = frame_.to_local(scene_.vertices);
    for (const Facet& facet : scene_.facets)
        corners_.push_back(facet.vertex);
    lay_apart();
    divisions_.reserve(scene_.facets.size());
    patches_.reserve(scene_.facets.size() * (two_sided_ ? 2 : 1));
    for (std::uint32_t f = 0; f < scene_.facets.size(); ++f)
        divide(f, options);
    find_colours();
}

void Mesh::find_colours() {
    colours_ = scene_.materials;
    std::vector<std::uint32_t> textured;
    for (std::uint32_t i = 0; i < patches_.size(); ++i)
        if (scene_.textures.on(patches_[i].material)) {
            patches_[i].colours = static_cast<std::uint32_t>(colours_.size() + textured.size());
            textured.push_back(i);
        }
    const std::size_t first = colours_.size();
    colours_.resize(first + textured.size());
    Workers(0).for_chunks(textured.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Patch& patch = patches_[textured[k]];
            const Colours mean = mean_colours(
                scene_, patch.facet, polygon_of(vertices_, corners_[patch.facet]), patch.shape);
            colours_[first + k].reflectance = mean.reflectance;
            colours_[first + k].emission = mean.emission;
        }
    });
}

Frame Mesh::hemisphere_frame(std::uint32_t patch) const {
    const double turn = static_cast<double>(mix_bits(patch + 1u) >> 11) * 0x1p-53;
    return Frame::from_normal(patches_[patch].normal).turned(2 * std::numbers::pi * turn);
}

FacetSoup Mesh::soup() const { return {vertices_, corners_}; }

FacetSoup Mesh::soup_to_trace() const {
    return {vertices_, corners_to_trace_.empty() ? corners_ : corners_to_trace_};
}

Patch Mesh::whole_side(std::uint32_t facet, bool back) const {
    return patch_from(polygon_of(vertices_, corners_[facet]), facet, back);
}

Patch Mesh::patch_from(const Polygon& shape, std::uint32_t facet, bool back) const {
    const double area = shape.area();
    Vec3 normal(0, 0, 1);
    if (area > 0)
        normal = shape.normal();
    else if (const Polygon whole = polygon_of(vertices_, corners_[facet]); whole.area() > 0)
        normal = whole.normal();
    return {
        back ? shape.flipped() : shape, shape.centre(), back ? -normal : normal,      area, facet,
        scene_.facets[facet].material,  back,           scene_.facets[facet].material};
}

void Mesh::lay_apart() {
    constexpr double step = 0x1p-28; // larger than what is taken for rounding elsewhere
    const CoplanarLayers layers = find_coplanar_layers(scene_, vertices_);
    for (std::uint32_t f = 0; f < layers.offset.size(); ++f) {
        const Polygon shape = polygon_of(vertices_, corners_[f]);
        if (layers.offset[f] == 0 || !(shape.area() > 0))
            continue;
        const bool triangle = shape.is_triangle();
        const Vec3 way = layers.offset[f] * step * shape.normal();
        const auto first = static_cast<std::uint32_t>(vertices_.size());
        for (const Vec3& corner : shape.corner)
            vertices_.push_back(corner + way);
        corners_[f] = {first, first + 1, first + 2, first + (triangle ? 2 : 3)};
    }
    laid_apart_ = layers.complete;
    if (!layers.buried.empty())
        corners_to_trace_ = corners_;
    for (const std::uint32_t f : layers.buried)
        corners_to_trace_[f].fill(corners_[f][0]);
}

void Mesh::divide(std::uint32_t f, const MeshOptions& options) {
    const Polygon shape = polygon_of(vertices_, corners_[f]);
    const bool is_whole =
        !(options.max_edge > 0) || scene_.materials[scene_.facets[f].material].is_far;
    const double max_edge =
        is_whole ? std::numeric_limits<double>::infinity() : options.max_edge * frame_.scale;
    Division division{};
    division.first_patch = static_cast<std::uint32_t>(patches_.size());
    const std::size_t room = options.max_patches - std::min(options.max_patches, patches_.size());
    std::vector<Polygon> made;
    if (shape.is_triangle())
        divide_triangle(division, shape, max_edge, room, made);
    else
        divide_quad(division, shape, max_edge, room, made);

    for (const Polygon& piece : made)
        add_patches(f, piece);
    divisions_.push_back(division);
    const bool divided = division.rows > 1 || division.columns > 1;
    only_patch_.push_back(divided ? none : division.first_patch);
}

void Mesh::add_patches(std::uint32_t facet, const Polygon& shape) {
    for (const bool back : {false, true})
        if (!back || has_back(facet))
            patches_.push_back(patch_from(shape, facet, back));
}

void Mesh::check_room(double count, std::size_t room) {
    if (!(count <= static_cast<double>(room)))
        throw std::invalid_argument("the division of faces makes too many patches; choose a larger "
                                    "maximal edge length");
}

void Mesh::divide_quad(Division& division, const Polygon& shape, double max_edge, std::size_t room,
                       std::vector<Polygon>& made) const {
    const auto& p = shape.corner;
    const auto longer = [](const Vec3& a, const Vec3& b) {
        return std::max(glm::length(a), glm::length(b));
    };
    const std::uint32_t n = pieces(longer(p[1] - p[0], p[2] - p[3]), max_edge);
    const std::uint32_t m = pieces(longer(p[3] - p[0], p[2] - p[1]), max_edge);
    check_room(double(n) * m, room);
    division.columns = n;
    division.rows = m;

    // g = ga e1 + gb e3 in the quad's plane, e1 and e3 being the edges at corner 0.
    const Vec3 e1 = p[1] - p[0], e3 = p[3] - p[0], g = p[0] - p[1] + p[2] - p[3];
    const double a = glm::dot(e1, e1), b = glm::dot(e1, e3), c = glm::dot(e3, e3);
    const double g1 = glm::dot(g, e1), g3 = glm::dot(g, e3), determinant = a * c - b * b;
    if (determinant > 0) {
        division.g_x = (g1 * c - g3 * b) / determinant;
        division.g_y = (g3 * a - g1 * b) / determinant;
    }
    if (n == 1 && m == 1) {
        made.push_back(shape);
        return;
    }
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        const double s = double(i) / n, t = double(j) / m;
        return (1 - t) * ((1 - s) * p[0] + s * p[1]) + t * ((1 - s) * p[3] + s * p[2]);
    };
    for (std::uint32_t j = 0; j < m; ++j)
        for (std::uint32_t i = 0; i < n; ++i)
            made.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)}});
}

void Mesh::divide_triangle(Division& division, const Polygon& shape, double max_edge,
                           std::size_t room, std::vector<Polygon>& made) const {
    const auto opposite = [&](std::size_t i) {
        return glm::length(shape.corner[(i + 2) % 3] - shape.corner[(i + 1) % 3]);
    };
    std::size_t apex = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (opposite(i) < opposite(apex))
            apex = i;
    const Vec3 a = shape.corner[apex];
    const Vec3 ab = shape.corner[(apex + 1) % 3] - a, ac = shape.corner[(apex + 2) % 3] - a;
    const std::uint32_t n = pieces(std::max(glm::length(ab), glm::length(ac)), max_edge);
    const std::uint32_t m = pieces(opposite(apex), max_edge);
    division.rows = n;
    division.columns = m;
    division.apex = static_cast<std::uint8_t>(apex);
    division.similar = 2 * m >= n;
    check_room(double(n) * (division.similar ? n : m), room);
    if (n == 1)
        made.push_back(shape);
    else if (division.similar)
        divide_similar(a, ab / double(n), ac / double(n), n, made);
    else
        divide_fan(a, ab, ac, n, m, made);
}

Mesh::Place Mesh::place_in_quad(const Division& division, const Hit& hit) const {
    // The point is corner0 + x e1 + y e3; corner 2 lies at (1 + g_x, 1 + g_y).
    const double to_corner2 = hit.second_half ? hit.u : hit.v;
    const double x = to_corner2 * (1 + division.g_x) + (hit.second_half ? 0 : hit.u);
    const double y = to_corner2 * (1 + division.g_y) + (hit.second_half ? hit.v : 0);
    // Bilinear: x = s + s t g_x, y = t + s t g_y. Eliminating s leaves a quadratic in t.
    const double b = 1 + x * division.g_y - y * division.g_x;
    const double t = 2 * y / (b + safe_sqrt(b * b + 4 * division.g_x * y));
    const double s = x / (1 + t * division.g_x);
    const std::uint32_t row = piece_at(t, division.rows), column = piece_at(s, division.columns);
    return {row * division.columns + column,
            {s * division.columns - column, t * division.rows - row}};
}

Mesh::Place Mesh::place_in_triangle(const Division& division, const Hit& hit) const {
    const std::array<double, 3> weight{1 - hit.u - hit.v, hit.u, hit.v};
    const double b = weight[(division.apex + 1u) % 3], c = weight[(division.apex + 2u) % 3];
    const std::uint32_t k = piece_at(b + c, division.rows);
    if (!division.similar) {
        const double across = c / (b + c);
        const std::uint32_t column = piece_at(across, division.columns);
        return {k * division.columns + column,
                {(b + c) * division.rows - k, across * division.columns - column}};
    }
    // Row k holds k + 1 upright triangles and between them k that are upside down.
    const std::uint32_t across = std::min(k, piece_at(c, division.rows));
    const bool upside_down = across < k && std::floor(b * division.rows) + across < k;
    // From the corner that all rows count from.
    const double to_b = b * division.rows - (k - across), to_c = c * division.rows - across;
    return {k * k + 2 * across + (upside_down ? 1 : 0),
            upside_down ? Vec2(to_b + to_c, -to_b) : Vec2(to_b, to_c)};
}

std::uint32_t Mesh::patch_at(const Hit& hit) const {
    const bool has_two = has_back(hit.facet);
    if (!hit.front && !has_two)
        return none;
    const Division& division = divisions_[hit.facet];
    const std::uint32_t side = hit.front ? 0 : 1;
    if (!is_divided(hit.facet))
        return division.first_patch + side;
    const bool triangle = scene_.facets[hit.facet].is_triangle();
    const Place place = triangle ? place_in_triangle(division, hit) : place_in_quad(division, hit);
    if (division.first_cell != none)
        return cells_.patch_at(division.first_cell + place.piece, triangle && division.similar,
                               place.inside) +
               side;
    return division.first_patch + (has_two ? 2 : 1) * place.piece + side;
}

std::uint32_t Mesh::pieces_of(std::uint32_t facet) const {
    const Division& division = divisions_[facet];
    return division.rows * (scene_.facets[facet].is_triangle() && division.similar
                                ? division.rows
                                : division.columns);
}

/// Of a patch's front.
CellShape Mesh::cell_shape(std::uint32_t facet, const Polygon& piece) const {
    const auto& p = piece.corner;
    const bool fan = scene_.facets[facet].is_triangle() && !divisions_[facet].similar;
    if (fan && piece.is_triangle()) // of the strip at the apex
        return {{p[0], p[1], p[2], p[0]}, false};
    return {p, !fan && piece.is_triangle()};
}

/// The patches and cells that there were, and how often they are to be divided.
struct Mesh::Refinement {
    std::vector<Patch> patches;
    std::vector<Division> divisions;
    CellTree cells;
    std::span<const std::uint8_t> levels;
    std::vector<std::uint32_t> parents; ///< of the patches there are now

    [[nodiscard]] int levels_of(std::uint32_t front, bool two_sided) const {
        return std::max(levels[front], two_sided ? levels[front + 1] : levels[front]);
    }
};

std::vector<std::uint32_t> Mesh::refine(std::span<const std::uint8_t> levels) {
    Refinement before{
        std::exchange(patches_, {}), divisions_, std::exchange(cells_, {}), levels, {}};
    for (std::uint32_t f = 0; f < divisions_.size(); ++f)
        refine_facet(f, before);
    find_colours();
    return std::move(before.parents);
}

void Mesh::refine_facet(std::uint32_t facet, Refinement& before) {
    Division& division = divisions_[facet];
    const std::uint32_t begin = division.first_patch;
    const std::uint32_t end = facet + 1 < divisions_.size()
                                  ? before.divisions[facet + 1].first_patch
                                  : static_cast<std::uint32_t>(before.patches.size());
    division.first_patch = static_cast<std::uint32_t>(patches_.size());
    const auto levels = before.levels.subspan(begin, end - begin);
    const bool had_cells = division.first_cell != none;
    if (!had_cells && std::ranges::all_of(levels, [](std::uint8_t level) { return level == 0; })) {
        for (std::uint32_t i = begin; i < end; ++i) {
            patches_.push_back(before.patches[i]);
            before.parents.push_back(i);
        }
        if (only_patch_[facet] != none)
            only_patch_[facet] = division.first_patch;
        return;
    }
    if (!is_divided(facet)) // its patch has the corners in the order of the file
        division.apex = 0;
    only_patch_[facet] = none;
    const std::uint32_t pieces = pieces_of(facet);
    const std::uint32_t old_cell = division.first_cell;
    division.first_cell = cells_.add(pieces);
    for (std::uint32_t q = 0; q < pieces; ++q) {
        if (had_cells) {
            refine_cell(division.first_cell + q, old_cell + q, facet, before);
            continue;
        }
        const std::uint32_t patch = begin + q * (has_back(facet) ? 2 : 1);
        refine_leaf(division.first_cell + q, cell_shape(facet, before.patches[patch].shape), facet,
                    before.levels_of(patch, has_back(facet)), patch, before);
    }
}

void Mesh::refine_cell(std::uint32_t cell, std::uint32_t before_cell, std::uint32_t facet,
                       Refinement& before) {
    const CellTree::Cell old = before.cells[before_cell];
    if (old.cut == CellCut::leaf)
        return refine_leaf(cell, cell_shape(facet, before.patches[old.first].shape), facet,
                           before.levels_of(old.first, has_back(facet)), old.first, before);
    const std::uint32_t count = old.cut == CellCut::four ? 4 : 2, first = cells_.add(count);
    cells_[cell] = {first, old.cut};
    for (std::uint32_t q = 0; q < count; ++q)
        refine_cell(first + q, old.first + q, facet, before);
}

void Mesh::refine_leaf(std::uint32_t cell, const CellShape& shape, std::uint32_t facet, int levels,
                       std::uint32_t parent, Refinement& before) {
    if (levels == 0) {
        cells_[cell] = {static_cast<std::uint32_t>(patches_.size()), CellCut::leaf};
        add_patches(facet, shape.polygon());
        for (std::uint32_t side = 0; side < (has_back(facet) ? 2 : 1); ++side)
            before.parents.push_back(parent + side);
        return;
    }
    const CellCut by = best_cut(shape);
    const std::vector<CellShape> pieces = cut(shape, by);
    const std::uint32_t first = cells_.add(static_cast<std::uint32_t>(pieces.size()));
    cells_[cell] = {first, by};
    for (std::uint32_t q = 0; q < pieces.size(); ++q)
        refine_leaf(first + q, pieces[q], facet, levels - 1, parent, before);
}

} // namespace hemilux
