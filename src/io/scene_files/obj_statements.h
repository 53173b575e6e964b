#pragma once
// The statements of an OBJ file one by one, as lists of what they say.

#include "geometry/vector.h"
#include "io/files/text_reader.h"
#include "io/scene_files/material_table.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace hemilux {

/// The number of times that something occurred, and its first line.
struct LineTally {
    std::size_t count = 0, first_line = 0;
    void add(std::size_t line) {
        if (count++ == 0)
            first_line = line;
    }
};

/// The content of a file, in its order.
struct ObjContents {
    /// A face as it stands in the file.
    struct Face {
        std::size_t first_corner;
        std::size_t line;
        std::uint32_t material, group;
    };
    static constexpr std::uint32_t no_texcoord = 0xffffffff;

    std::vector<Vec3> vertices;
    std::vector<Face> faces;
    std::vector<std::uint32_t> corners; ///< vertices of all faces, which may not be there
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> texcoord_of_corner; ///< empty where textures are not read
    std::vector<std::string> groups;
    LineTally free_form, lines_and_points, capitals, odd_texcoords, coloured;

    [[nodiscard]] std::span<const std::uint32_t> corners_of(std::size_t face) const {
        const std::size_t begin = faces[face].first_corner;
        const std::size_t end =
            face + 1 < faces.size() ? faces[face + 1].first_corner : corners.size();
        return std::span(corners).subspan(begin, end - begin);
    }
};

class ObjStatements {
  public:
    /// `path` is for messages.
    ObjStatements(const std::string& path, bool textures, MaterialTable& materials,
                  ObjContents& contents)
        : path_(path), textures_(textures), materials_(materials), contents_(contents) {}

    /// Adds what a statement says to the contents. Throws InputError with file and line.
    void read(const Statement& statement);

  private:
    void read_face(const Statement& statement);
    void read_texcoord(const Statement& statement);
    void read_corner(std::string_view word, std::size_t line);
    void read_group(std::string_view names);
    void resolve_names();

    const std::string& path_;
    bool textures_;
    MaterialTable& materials_;
    ObjContents& contents_;
    std::unordered_map<std::string, std::uint32_t> group_index_;
    /// The latest names, and their numbers once a face has used them.
    std::string material_name_ = default_name, group_name_ = default_name;
    std::size_t material_line_ = 0;
    std::uint32_t material_ = none, group_ = none;

    static constexpr const char* default_name = "default";
    static constexpr std::uint32_t none = 0xffffffff;
};

} // namespace hemilux
