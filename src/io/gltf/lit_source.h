#pragma once
// A glTF file that is read once more, to be written again with a lightmap: its texture coordinates,
// and the numbers of its vertices.

#include "io/files/outside_files.h"
#include "io/gltf/elements.h"
#include "io/gltf/primitives.h"
#include "io/scene_files/read_result.h"
#include "radiosity/answers/charts/chart_regions.h"
#include "radiosity/answers/lightmaps/file_places.h"
#include "radiosity/answers/lightmaps/smooth_point.h"
#include "radiosity/answers/lightmaps/texel_map.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hemilux {

class Mesh;

namespace gltf {

class LitSource {
  public:
    /// Reads the file. `origins` say what was read from it before. Throws InputError, also where
    /// the file has changed since, and for pictures outside of its folder where these are refused.
    LitSource(const std::string& path, const ReadGuard& guard, Outside outside,
              std::vector<PrimitiveOrigin> origins);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const Document& document() const { return document_; }
    [[nodiscard]] const Container& container() const { return container_; }
    [[nodiscard]] Buffers& buffers() { return buffers_; }
    [[nodiscard]] const std::vector<PrimitiveOrigin>& origins() const { return origins_; }
    [[nodiscard]] const Primitive& primitive_of(const PrimitiveOrigin& origin) const {
        return document_.meshes[origin.mesh].primitives[origin.primitive];
    }
    /// Returns the path of each image that lies in a file of its own, which will be part of what is
    /// written; empty for the others.
    [[nodiscard]] const std::vector<std::string>& pictures() const { return pictures_; }
    /// Returns the bytes of the file, its buffers and its pictures.
    [[nodiscard]] double bytes() const;
    /// Returns what was noticed: the first picture outside of the file's folder.
    [[nodiscard]] const std::vector<std::string>& warnings() const { return reported_; }
    /// Returns the triangles of an origin with texture coordinates of so many sets.
    [[nodiscard]] Triangles triangles_of(const PrimitiveOrigin& origin, std::size_t sets);
    /// Returns the normals at an origin's points, unit, in the world; zero where the file has none
    /// that is a direction. Throws InputError for elements of a wrong kind.
    [[nodiscard]] std::vector<Vec3> normals_of(const PrimitiveOrigin& origin);
    /// Returns the number of the sets that the primitive with most of them has.
    [[nodiscard]] std::size_t texcoord_sets() const;

  private:
    std::string path_;
    const ReadGuard guard_;
    Container container_;
    Document document_;
    std::vector<std::string> reported_;
    OutsideFiles outside_;
    Buffers buffers_;
    TriangleReader triangles_;
    std::vector<PrimitiveOrigin> origins_;
    std::vector<std::string> pictures_;
    using Shown = std::pair<std::size_t, std::optional<std::size_t>>; ///< node, number of instance
    std::map<Shown, glm::dmat4> to_world_; ///< found when normals are first asked for
    [[nodiscard]] const glm::dmat4& to_world(const PrimitiveOrigin& origin);
};

/// The facets of the scene by face; none where a face has no area.
[[nodiscard]] std::vector<std::uint32_t> facets_by_face(const Mesh& mesh);

/// Returns the normals that the file has at the corners of facets, by facet; those of a facet that
/// looks the other way in the scene are turned around. Throws as LitSource::normals_of().
[[nodiscard]] std::vector<CornerNormals> normals_of_file(LitSource& source, const Mesh& mesh);

/// Returns the places of these sides in a set of the file, as far as they are of the origins with
/// these numbers. Charts are triangles that meet in the set as they do on the surface.
[[nodiscard]] PlacesOfFile places_in_set(LitSource& source, const Mesh& mesh,
                                         std::span<const ChartSide> sides, std::size_t set,
                                         std::span<const std::size_t> origins);

/// The texture coordinates of a primitive in an atlas. Vertices at which charts meet are there once
/// for each chart: the further ones stand behind those of the file.
struct AtlasCoordinates {
    std::size_t origin;
    std::vector<glm::vec2> places;      ///< in [0,1], by vertex
    std::vector<std::uint32_t> further; ///< vertices of the file that the further ones copy
    std::vector<std::array<std::uint32_t, 3>> corners; ///< vertices by triangle
};
/// Returns the coordinates of primitives of which some triangle is placed, from places in [0,1], as
/// far as they are of the origins with these numbers.
[[nodiscard]] std::vector<AtlasCoordinates>
atlas_coordinates(LitSource& source, const Mesh& mesh, std::span<const PlacedTriangle> triangles,
                  std::span<const std::size_t> origins);

} // namespace gltf
} // namespace hemilux
