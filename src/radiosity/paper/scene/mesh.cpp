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
            for (const bool back : {false, true})
                if (!back || has_back(f))
                    patches_.push_back(patch_from(piece, f, back));
}

void Mesh::take_finer(std::vector<Patch> patches, std::span<const std::uint32_t> first_patch,
                      std::shared_ptr<const FinerPatches> finer) {
    patches_ = std::move(patches);
    finer_ = std::move(finer);
    for (std::uint32_t f = 0; f < divisions_.size(); ++f) {
        auto& [pieces, first] = divisions_[f];
        first = first_patch[f];
        only_patch_[f] = pieces.pieces() > 1 || finer_->divides(f) ? none : first;
    }
    find_colours();
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
    if (finer_ && finer_->divides(hit.facet))
        return finer_->patch_at(hit.facet, division.pieces, place) + side;
    return division.first_patch + (has_two ? 2 : 1) * place.piece + side;
}

} // namespace hemilux
