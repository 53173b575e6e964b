#include "io/gltf/lit_source.h"

#include "bvh/tracer.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/gltf/document/uri.h"
#include "io/gltf/instances.h"
#include "io/gltf/scene_meshes.h"
#include "radiosity/answers/charts/chart_regions.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

namespace hemilux::gltf {
namespace {

Document document_of(const Container& container, const std::string& path) {
    const JsonDocument json(container.json, path);
    return read_document(json.root());
}

/// Returns the file of an image; empty where it has none that can be read, and stays as it is.
std::string file_of(const ImageInfo& image, const std::string& scene, const std::string& place) {
    if (image.uri.empty() || image.uri.starts_with("data:"))
        return "";
    try {
        const UriContent content = content_of_uri(image.uri, scene, place);
        return is_input(content.file, InputKind::regular) ? content.file : "";
    } catch (const InputError&) { // as of pages of the web
        return "";
    }
}

/// Returns the points of an origin that the corners of a facet of it were read as.
std::array<std::uint32_t, 4> points_of(const Facet& facet, const PrimitiveOrigin& origin) {
    std::array<std::uint32_t, 4> points{};
    for (std::size_t k = 0; k < points.size(); ++k)
        points[k] = facet.vertex[k] - origin.first_vertex;
    return points;
}

} // namespace

LitSource::LitSource(const std::string& path, const ReadGuard& guard, Outside outside,
                     std::vector<PrimitiveOrigin> origins)
    : path_(path), guard_(guard), container_(read_container(path_, guard_)),
      document_(document_of(container_, path_)), outside_(path_, outside, reported_),
      buffers_(document_, container_, path_, guard_, outside_), triangles_(buffers_),
      origins_(std::move(origins)) {
    for (const PrimitiveOrigin& origin : origins_) {
        const bool is_there = origin.mesh < document_.meshes.size() &&
                              origin.primitive < document_.meshes[origin.mesh].primitives.size() &&
                              origin.node < document_.nodes.size();
        if (!is_there || count_triangles(primitive_of(origin), buffers_,
                                         place_of(origin.mesh, origin.primitive)) != origin.faces)
            throw InputError(path_, "the file has changed since it was read");
    }
    for (const ImageInfo& image : document_.images) {
        const std::string place = "/images/" + std::to_string(pictures_.size()) + "/uri";
        pictures_.push_back(file_of(image, path_, place));
        if (!pictures_.back().empty())
            outside_.check(pictures_.back(), path_ + ": " + place, "texture");
    }
}

double LitSource::bytes() const {
    auto bytes = static_cast<double>(container_.content.size());
    for (const auto& buffer : document_.buffers)
        bytes += static_cast<double>(buffer.length);
    for (const std::string& picture : pictures_) {
        std::error_code error;
        const auto size = std::filesystem::file_size(picture, error);
        bytes += picture.empty() || error ? 0 : static_cast<double>(size);
    }
    return bytes;
}

Triangles LitSource::triangles_of(const PrimitiveOrigin& origin, std::size_t sets) {
    const Primitive& primitive = primitive_of(origin);
    Triangles triangles = triangles_.read(primitive, place_of(origin.mesh, origin.primitive),
                                          std::min(sets, primitive.texcoords.size()));
    if (triangles.points.size() != origin.vertices)
        throw InputError(path_, "the file has changed since it was read");
    return triangles;
}

const glm::dmat4& LitSource::to_world(const PrimitiveOrigin& origin) {
    if (to_world_.empty())
        for (const Instance& instance : instances_of(document_))
            if (document_.nodes[instance.node].mesh)
                for (const Instance& placed : placed_meshes(instance, buffers_))
                    to_world_[{placed.node, placed.number}] = placed.to_world;
    return to_world_.at({origin.node, origin.instance});
}

std::vector<Vec3> LitSource::normals_of(const PrimitiveOrigin& origin) {
    std::vector<Vec3> normals(origin.vertices, Vec3(0.0));
    const Index& accessor = primitive_of(origin).normals;
    if (!accessor)
        return normals;
    const Elements elements(buffers_, *accessor);
    elements.check("VEC3", {Component::int8, Component::int16, Component::float32});
    const Triangles triangles = triangles_of(origin, 0);
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(to_world(origin))));
    for (std::size_t k = 0; k < normals.size(); ++k) {
        const std::size_t v = triangles.vertex[k];
        if (v >= elements.size())
            elements.fail("expected as many elements as vertices, found " +
                          std::to_string(elements.size()));
        const Vec3 normal = turn * Vec3(elements.at(v, 0), elements.at(v, 1), elements.at(v, 2));
        const double length = glm::length(normal);
        if (length > 0 && std::isfinite(length))
            normals[k] = normal / length;
    }
    return normals;
}

std::size_t LitSource::texcoord_sets() const {
    std::size_t sets = 0;
    for (const PrimitiveOrigin& origin : origins_)
        sets = std::max(sets, primitive_of(origin).texcoords.size());
    return sets;
}

std::vector<std::uint32_t> facets_by_face(const Mesh& mesh) {
    std::vector<std::uint32_t> by_face(mesh.scene().faces, none);
    for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
        if (const std::uint32_t face = mesh.scene().facets[f].face; face < by_face.size())
            by_face[face] = f;
    return by_face;
}

std::vector<CornerNormals> normals_of_file(LitSource& source, const Mesh& mesh) {
    const Scene& scene = mesh.scene();
    const std::vector<std::uint32_t> by_face = facets_by_face(mesh);
    std::vector<CornerNormals> normals(scene.facets.size());
    for (const PrimitiveOrigin& origin : source.origins()) {
        const std::vector<Vec3> of_points = source.normals_of(origin);
        for (std::uint32_t t = 0; t < origin.faces; ++t) {
            const std::uint32_t f = by_face[origin.first_face + t];
            if (f == none)
                continue;
            const auto points = points_of(scene.facets[f], origin);
            std::array<Vec3, 4> of_corners{};
            Vec3 sum(0.0);
            bool all = true;
            for (std::size_t k = 0; k < 4; ++k) {
                of_corners[k] = of_points[points[k]];
                all = all && of_corners[k] != Vec3(0.0);
                sum += k < 3 ? of_corners[k] : Vec3(0.0);
            }
            const double side = glm::dot(sum, mesh.shape_of(f).area_vector()) < 0 ? -1 : 1;
            for (std::size_t k = 0; all && k < 4; ++k)
                normals[f][k] = glm::vec3(side * of_corners[k]);
        }
    }
    return normals;
}

PlacesOfFile places_in_set(LitSource& source, const Mesh& mesh, std::span<const ChartSide> sides,
                           std::size_t set, std::span<const std::size_t> origins) {
    const Scene& scene = mesh.scene();
    std::vector<std::uint32_t> side_of(scene.facets.size(), none);
    for (std::uint32_t s = 0; s < sides.size(); ++s)
        side_of[sides[s].facet] = s;
    const std::vector<std::uint32_t> by_face = facets_by_face(mesh);
    PlacesOfFile found;
    for (const std::size_t o : origins) {
        const PrimitiveOrigin& origin = source.origins()[o];
        const Triangles triangles = source.triangles_of(origin, set + 1);
        for (std::uint32_t t = 0; t < origin.faces; ++t) {
            const std::uint32_t f = by_face[origin.first_face + t];
            if (f == none || side_of[f] == none)
                continue;
            const Facet& facet = scene.facets[f];
            if (triangles.texcoords.size() <= set) {
                found.add_without(facet.group);
                continue;
            }
            const auto points = points_of(facet, origin);
            PlacedTriangle placed{f, sides[side_of[f]].back, false, 0, {}};
            for (std::size_t k = 0; k < 3; ++k)
                placed.place[k] = triangles.texcoords[set][points[k]];
            found.add(placed, facet.group);
        }
    }
    found.join_charts(mesh);
    return found;
}

std::vector<AtlasCoordinates> atlas_coordinates(LitSource& source, const Mesh& mesh,
                                                std::span<const PlacedTriangle> triangles,
                                                std::span<const std::size_t> origins) {
    const Scene& scene = mesh.scene();
    std::vector<std::uint32_t> placed_of(scene.facets.size(), none);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        placed_of[triangles[t].facet] = t;
    const std::vector<std::uint32_t> by_face = facets_by_face(mesh);
    std::vector<AtlasCoordinates> all;
    for (const std::size_t o : origins) {
        const PrimitiveOrigin& origin = source.origins()[o];
        const Triangles read = source.triangles_of(origin, 0);
        const Primitive& primitive = source.primitive_of(origin);
        if (!primitive.position)
            continue;
        const std::size_t vertices = source.document().accessors[*primitive.position].count;
        AtlasCoordinates coordinates{o, std::vector<glm::vec2>(vertices, glm::vec2(0.0f)), {}, {}};
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number; // vertex, chart
        std::vector<bool> is_placed(vertices);
        bool any = false;
        for (std::uint32_t t = 0; t < origin.faces; ++t) {
            auto& corners = coordinates.corners.emplace_back();
            const std::uint32_t f = by_face[origin.first_face + t];
            const std::uint32_t place = f == none ? none : placed_of[f];
            std::array<std::uint32_t, 4> points{};
            if (place != none)
                points = points_of(scene.facets[f], origin);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t point = read.corners[t][k], vertex = read.vertex[point];
                corners[k] = vertex;
                if (place == none)
                    continue;
                any = true;
                const PlacedTriangle& placed = triangles[place];
                const auto [found, is_new] = number.try_emplace(std::pair(vertex, placed.chart), 0);
                if (is_new) {
                    found->second = vertex;
                    if (is_placed[vertex]) {
                        found->second = static_cast<std::uint32_t>(coordinates.places.size());
                        coordinates.places.emplace_back();
                        coordinates.further.push_back(vertex);
                    }
                    is_placed[vertex] = true;
                    const auto corner = std::ranges::find(points, point) - points.begin();
                    coordinates.places[found->second] =
                        glm::vec2(placed.place[static_cast<std::size_t>(corner)]);
                }
                corners[k] = found->second;
            }
        }
        if (any)
            all.push_back(std::move(coordinates));
    }
    return all;
}

} // namespace hemilux::gltf
