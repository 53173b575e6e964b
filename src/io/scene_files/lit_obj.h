#pragma once
// An OBJ file that is read once more, to be written again with other texture coordinates. All else
// of its text stays as it is, byte for byte.

#include "io/files/outside_files.h"
#include "io/scene_files/read_result.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hemilux {

class LitObj {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// A corner of a face, a line or a point, by numbers from 0; texture coordinates and normals
    /// may be none, and may be beyond the last one.
    struct Corner {
        std::size_t begin, end; ///< bytes of its word
        std::uint32_t vertex, place, normal;
    };
    /// The bytes of a face from its keyword to its last corner.
    struct Face {
        std::size_t begin, end, first_corner, corners;
    };
    /// A piece of a face that is written as a face of its own: numbers of corners within the face,
    /// and of new places.
    using Piece = std::vector<std::pair<std::size_t, std::uint32_t>>;
    /// The new places of a face: one for each corner, or some pieces instead. A face without any
    /// keeps those that it has.
    struct NewPlaces {
        std::vector<std::uint32_t> of_corners;
        std::vector<Piece> pieces;
    };

    /// Reads the file, which was read as a scene before. Throws InputError.
    explicit LitObj(const std::string& path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }
    [[nodiscard]] std::span<const Corner> corners_of(std::size_t face) const {
        return std::span(corners_).subspan(faces_[face].first_corner, faces_[face].corners);
    }
    [[nodiscard]] std::span<const glm::vec2> places() const { return places_; }
    [[nodiscard]] std::span<const glm::vec3> normals() const { return normals_; }
    /// Returns whether it names libraries of materials, which lie beside it.
    [[nodiscard]] bool has_libraries() const { return has_libraries_; }
    /// Returns the text as it is.
    [[nodiscard]] std::string text() const { return mark_ + text_; }
    /// Returns the text with these places, which stand before the first face; `of_face` is by face.
    /// References to places of the file that come later are counted on.
    [[nodiscard]] std::string text_with(std::span<const glm::vec2> places,
                                        std::span<const NewPlaces> of_face) const;

  private:
    void read_corners(std::string_view rest, const char* content);
    [[nodiscard]] std::uint32_t moved(std::uint32_t place, std::size_t added) const;

    std::string path_, text_, mark_; ///< the byte order mark before the text, if there is one
    std::vector<Face> faces_;
    std::vector<Corner> corners_;       ///< of faces
    std::vector<Corner> other_corners_; ///< of lines, after the first face or before it
    std::vector<glm::vec2> places_;
    std::vector<glm::vec3> normals_;
    std::size_t vertices_ = 0, places_before_ = 0; ///< places before the first face
    bool has_libraries_ = false;
};

} // namespace hemilux
