#include "radiosity/paper/scene/mesh.h"

#include "geometry/elementary.h"
#include "radiosity/paper/sampling/rng.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace hemilux {

double radius_of(const Patch& patch) {
    double squares = 0;
    for (const Vec3& corner : patch.shape.corner)
        squares = std::max(squares, glm::dot(corner - patch.centre, corner - patch.centre));
    return std::sqrt(squares);
}

/// Centres the frame on the box around all facets and scales it by the largest distance of a corner
/// from the centre. Where most facets lie in a small part of that box, as under a distant sun, the
/// centre of that part is taken. Floats are most precise there.
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
        const auto [lowest, highest] = std::minmax_element(places.begin(), places.end());
        const double low = *lowest, high = *highest;
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

LocalFacets::LocalFacets(const Scene& scene) {
    if (scene.facets.empty())
        throw std::invalid_argument("the scene has no face with an area");
    frame = LocalFrame::of(scene);
    vertices = frame.to_local(scene.vertices);
    for (const Facet& facet : scene.facets)
        corners.push_back(facet.vertex);
}

Mesh::Mesh(Scene scene, const MeshOptions& options)
    : scene_(std::move(scene)), facets_(scene_), two_sided_(options.two_sided),
      threads_(options.threads) {
    divide(options);
    find_colours();
}

Mesh::Mesh(Scene scene, const MeshOptions& options, LocalFacets facets)
    : scene_(std::move(scene)), facets_(std::move(facets)), two_sided_(options.two_sided),
      threads_(options.threads) {
    divide(options);
    find_colours();
}

void Mesh::find_colours() {
    colours_ = scene_.materials;
    std::vector<std::uint32_t> varying;
    for (std::uint32_t i = 0; i < patches_.size(); ++i)
        if (scene_.colours_vary_on(patches_[i].material)) {
            patches_[i].colours = static_cast<std::uint32_t>(colours_.size() + varying.size());
            varying.push_back(i);
        }
    if (varying.empty())
        return;
    for (const Colours& mean : scene_.varying->means(*this, varying, threads_))
        colours_.push_back(
            {.name = {}, .reflectance = mean.reflectance, .emission = mean.emission});
}

void Mesh::vary_colours(std::shared_ptr<VaryingColours> colours) {
    scene_.varying = std::move(colours);
    find_colours();
}

void Mesh::recolour(Scene scene) {
    scene_ = std::move(scene);
    for (Patch& patch : patches_)
        patch.colours = patch.material = scene_.facets[patch.facet].material;
    find_colours();
}

Frame Mesh::hemisphere_frame(std::uint32_t patch) const {
    return hemisphere_frame(patch, hemisphere_turn(patch));
}

Vec2 Mesh::hemisphere_turn(std::uint32_t patch) {
    const double angle =
        2 * std::numbers::pi * (static_cast<double>(mix_bits(patch + 1u) >> 11) * 0x1p-53);
    return elementary::on_circle(angle);
}

FacetSoup Mesh::soup() const { return {facets_.vertices, facets_.corners}; }

FacetSoup Mesh::soup_to_trace() const {
    const auto& [frame, vertices, corners, to_trace, all] = facets_;
    return {vertices, to_trace.empty() ? corners : to_trace};
}

Patch Mesh::whole_side(std::uint32_t facet, bool back) const {
    return patch_from(shape_of(facet), facet, back);
}

Patch Mesh::patch_from(const Polygon& shape, std::uint32_t facet, bool back) const {
    const double area = shape.area();
    Vec3 normal(0, 0, 1);
    if (area > 0)
        normal = shape.normal();
    else if (const Polygon whole = shape_of(facet); whole.area() > 0)
        normal = whole.normal();
    return {
        back ? shape.flipped() : shape, shape.centre(), back ? -normal : normal,      area, facet,
        scene_.facets[facet].material,  back,           scene_.facets[facet].material};
}

void Mesh::divide(const MeshOptions& options) {
    divisions_.reserve(scene_.facets.size());
    std::size_t patches = 0;
    for (std::uint32_t f = 0; f < scene_.facets.size(); ++f) {
        const bool is_whole =
            !(options.max_edge > 0) || scene_.materials[scene_.facets[f].material].is_far;
        const double max_edge = is_whole ? std::numeric_limits<double>::infinity()
                                         : options.max_edge * facets_.frame.scale;
        const std::size_t sides = has_back(f) ? 2 : 1;
        const std::size_t left = options.max_patches - std::min(options.max_patches, patches);
        const FacetDivision pieces(shape_of(f), max_edge, left / sides);
        const auto first_patch = static_cast<std::uint32_t>(patches);
        divisions_.push_back({pieces, first_patch});
        only_patch_.push_back(pieces.pieces() > 1 ? none : first_patch);
        patches += pieces.pieces() * sides;
    }
    patches_.reserve(patches);
    for (std::uint32_t f = 0; f < scene_.facets.size(); ++f)
        for (const Polygon& piece : divisions_[f].pieces.cut(shape_of(f)))
            add_patches(f, piece);
}

void Mesh::add_patches(std::uint32_t facet, const Polygon& shape) {
    for (const bool back : {false, true})
        if (!back || has_back(facet))
            patches_.push_back(patch_from(shape, facet, back));
}

std::uint32_t Mesh::patch_at(const Hit& hit) const {
    const bool has_two = has_back(hit.facet);
    if (!hit.front && !has_two)
        return none;
    const Division& division = divisions_[hit.facet];
    const std::uint32_t side = hit.front ? 0 : 1;
    if (!is_divided(hit.facet))
        return division.first_patch + side;
    const FacetDivision::Place place = division.pieces.place_of(hit);
    if (division.first_cell != none)
        return cells_.patch_at(division.first_cell + place.piece, division.pieces.is_similar(),
                               place.inside) +
               side;
    return division.first_patch + (has_two ? 2 : 1) * place.piece + side;
}

/// Returns the shape, as a cell, of a piece that is a patch's front.
CellShape Mesh::cell_shape(std::uint32_t facet, const Polygon& piece) const {
    const auto& p = piece.corner;
    const bool fan = divisions_[facet].pieces.is_fan();
    if (fan && piece.is_triangle()) // of the strip at the apex
        return {{p[0], p[1], p[2], p[0]}, false};
    return {p, !fan && piece.is_triangle()};
}

/// The patches and cells before a refinement, and how often they are to be divided.
struct Mesh::Refinement {
    std::vector<Patch> patches;
    std::vector<Division> divisions;
    CellTree cells;
    std::span<const std::uint8_t> levels;
    std::vector<std::uint32_t> parents; ///< parents of the patches there are now

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
    if (!had_cells &&
        std::all_of(levels.begin(), levels.end(), [](std::uint8_t level) { return level == 0; })) {
        for (std::uint32_t i = begin; i < end; ++i) {
            patches_.push_back(before.patches[i]);
            before.parents.push_back(i);
        }
        if (only_patch_[facet] != none)
            only_patch_[facet] = division.first_patch;
        return;
    }
    only_patch_[facet] = none;
    const std::uint32_t pieces = division.pieces.pieces();
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
