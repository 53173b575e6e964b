#include "io/scene_files/obj_places.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

namespace hemilux {
namespace {

/// Returns which corner of its face has this vertex; none where it is not one alone.
std::optional<std::size_t> corner_with(std::span<const LitObj::Corner> corners,
                                       std::uint32_t vertex) {
    std::optional<std::size_t> found;
    for (std::size_t k = 0; k < corners.size(); ++k)
        if (corners[k].vertex == vertex) {
            if (found)
                return std::nullopt;
            found = k;
        }
    return found;
}

/// Returns the corners of a facet that a triangle of it has.
std::array<std::size_t, 3> corners_of_half(bool second) {
    return second ? std::array<std::size_t, 3>{0, 2, 3} : std::array<std::size_t, 3>{0, 1, 2};
}

/// Numbers places as they are first used, each once for a vertex and a chart.
class NewPlaceNumbers {
  public:
    std::uint32_t of(std::uint32_t vertex, const PlacedTriangle& triangle, const Vec2& place) {
        const auto [found, is_new] =
            number_.try_emplace({vertex, triangle.chart}, static_cast<std::uint32_t>(all_.size()));
        if (is_new)
            all_.emplace_back(static_cast<float>(place.x), static_cast<float>(1 - place.y));
        return found->second;
    }
    [[nodiscard]] const std::vector<glm::vec2>& all() const { return all_; }

  private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number_; // vertex, chart
    std::vector<glm::vec2> all_;
};

/// Returns which corner of its face a facet's corner is. Where several have its vertex, any does:
/// they are in one place.
std::size_t any_corner_with(std::span<const LitObj::Corner> corners, std::uint32_t vertex) {
    return static_cast<std::size_t>(std::ranges::find(corners, vertex, &LitObj::Corner::vertex) -
                                    corners.begin());
}

} // namespace

PlacesOfFile places_in_obj(const LitObj& file, const Mesh& mesh, std::span<const ChartSide> sides) {
    PlacesOfFile found;
    for (const ChartSide& side : sides) {
        const Scene& scene = mesh.scene();
        const Facet& facet = scene.facets[side.facet];
        const std::span<const LitObj::Corner> corners = file.corners_of(facet.face);
        for (const bool second : {false, true}) {
            if (second && facet.is_triangle())
                continue;
            PlacedTriangle placed{side.facet, side.back, second, side.facet, {}};
            bool is_there = true;
            const auto half = corners_of_half(second);
            for (std::size_t k = 0; is_there && k < 3; ++k) {
                const auto corner = corner_with(corners, facet.vertex[half[k]]);
                is_there = corner && corners[*corner].place < file.places().size();
                if (!is_there)
                    continue;
                const Vec2 place(file.places()[corners[*corner].place]);
                placed.place[k] = {place.x, 1 - place.y};
            }
            if (is_there)
                found.add(placed, facet.group);
            else
                found.add_without(facet.group);
        }
    }
    found.join_charts(mesh);
    return found;
}

std::string text_with_atlas(const LitObj& file, const Mesh& mesh,
                            std::span<const PlacedTriangle> triangles) {
    const Scene& scene = mesh.scene();
    const std::vector<Facet>& facets = scene.facets;
    NewPlaceNumbers numbers;
    std::vector<LitObj::NewPlaces> of_face(file.faces().size());
    std::vector<std::optional<std::uint32_t>> chart_of(file.faces().size());
    std::vector<bool> is_divided(file.faces().size());
    for (const PlacedTriangle& triangle : triangles) {
        const std::uint32_t face = facets[triangle.facet].face;
        const auto corners = file.corners_of(face);
        is_divided[face] =
            is_divided[face] || chart_of[face].value_or(triangle.chart) != triangle.chart;
        chart_of[face] = triangle.chart;
        std::vector<std::uint32_t>& places = of_face[face].of_corners;
        places.resize(corners.size(), LitObj::none);
        LitObj::Piece& piece = of_face[face].pieces.emplace_back();
        const auto half = corners_of_half(triangle.second_half);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = facets[triangle.facet].vertex[half[k]];
            const std::uint32_t place = numbers.of(vertex, triangle, triangle.place[k]);
            piece.emplace_back(any_corner_with(corners, vertex), place);
            for (std::size_t c = 0; c < corners.size(); ++c)
                if (corners[c].vertex == vertex)
                    places[c] = place;
        }
    }
    for (std::size_t face = 0; face < of_face.size(); ++face) {
        LitObj::NewPlaces& found = of_face[face];
        // A corner that no triangle has lies on an edge, and gets a place only with the pieces.
        if (is_divided[face] ||
            std::ranges::find(found.of_corners, LitObj::none) != found.of_corners.end())
            found.of_corners.clear();
        else
            found.pieces.clear();
    }
    return file.text_with(numbers.all(), of_face);
}

std::vector<CornerNormals> normals_of_obj(const LitObj& file, const Mesh& mesh) {
    const Scene& scene = mesh.scene();
    const std::vector<Facet>& facets = scene.facets;
    std::vector<CornerNormals> normals(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (facets[f].face >= file.faces().size()) // of an emitter that was added
            continue;
        const auto corners = file.corners_of(facets[f].face);
        CornerNormals of_facet{};
        Vec3 sum(0.0);
        bool all = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t corner = any_corner_with(corners, facets[f].vertex[k]);
            const bool is_there = corner < corners.size() &&
                                  corners[corner].normal < file.normals().size() &&
                                  file.normals()[corners[corner].normal] != glm::vec3(0.0f);
            all = all && is_there;
            if (!all)
                break;
            of_facet[k] = glm::normalize(file.normals()[corners[corner].normal]);
            sum += Vec3(of_facet[k]);
        }
        const auto front = static_cast<std::uint32_t>(f);
        const float side = glm::dot(sum, mesh.shape_of(front).area_vector()) < 0 ? -1.0f : 1.0f;
        for (std::size_t k = 0; all && k < 4; ++k)
            normals[f][k] = side * of_facet[k];
    }
    return normals;
}

} // namespace hemilux
