#include "io/scene_files/stl.h"

#include "io/files/error.h"
#include "io/files/little_endian.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/light/polygons/polygon_division.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace hemilux {
namespace {

constexpr std::size_t header = 80, count_bytes = 4, record = 50;

/// Many binary files begin with "solid" too: their length decides, and a text has no zero byte.
bool is_binary(std::string_view content) {
    constexpr std::string_view first_word = "solid";
    const std::size_t begin = std::min(content.find_first_not_of(" \t\r\n"), content.size());
    return small_letters(content.substr(begin, first_word.size())) != first_word ||
           content.find('\0') != std::string_view::npos ||
           (content.size() >= header + count_bytes &&
            content.size() == header + count_bytes + record * word_at(content, header));
}

class StlReader {
  public:
    StlReader(const std::string& path, const ReadGuard& guard) : path_(path), guard_(guard) {}
    ReadResult read();

  private:
    void read_binary(std::string_view content);
    void read_text(std::string content);
    void read_statement(const Statement& statement);
    void read_corner(const Statement& statement);
    void end_facet(const Statement& statement);
    void add_triangle(const std::array<Vec3, 3>& corners);
    std::uint32_t vertex_at(const Vec3& place);
    [[noreturn]] void fail_at_byte(std::size_t at, const std::string& message) const {
        throw InputError(path_, "byte " + std::to_string(at) + ": " + message);
    }

    std::string path_;
    const ReadGuard& guard_;
    std::unordered_map<Vec3, std::uint32_t, PositionHash> vertices_;
    std::vector<Vec3> corners_; ///< corners of the facet that is read
    std::uint32_t group_ = 0;
    PolygonDivision division_;
    ReadResult result_;
};

ReadResult StlReader::read() {
    std::string content = read_input(path_, InputKind::stream, [this](std::string_view read) {
        constexpr double bytes_per_byte = 5; // vertices, facets and the map of places
        if (guard_)
            guard_(bytes_per_byte * static_cast<double>(read.size()));
    });
    if (content.starts_with(byte_order_mark))
        content.erase(0, byte_order_mark.size());
    result_.scene.materials.emplace_back().name = "default";
    result_.material_source.emplace_back();
    if (is_binary(content))
        read_binary(content);
    else
        read_text(std::move(content));
    if (result_.scene.facets.empty())
        throw InputError(path_, result_.scene.faces > 0 ? "none of the triangles has an area"
                                                        : "no triangles; expected an STL file");
    if (result_.degenerate_faces > 0)
        result_.warnings.push_back(path_ + ": triangles without area are left out: " +
                                   std::to_string(result_.degenerate_faces));
    return std::move(result_);
}

void StlReader::read_binary(std::string_view content) {
    if (content.size() < header + count_bytes)
        throw InputError(path_, "expected an STL file: a text that begins with solid, or at least "
                                "84 bytes, found " +
                                    std::to_string(content.size()));
    const std::size_t count = word_at(content, header);
    const std::size_t most = (content.size() - header - count_bytes) / record;
    if (count > most)
        fail_at_byte(header, "expected at most " + std::to_string(most) +
                                 (most == 1 ? " triangle" : " triangles") + ", as the file has " +
                                 std::to_string(content.size()) + " bytes, found " +
                                 std::to_string(count));
    if (const std::size_t behind = content.size() - header - count_bytes - count * record)
        result_.warnings.push_back(
            path_ + ": byte " + std::to_string(header) + ": the file counts " +
            std::to_string(count) + (count == 1 ? " triangle; " : " triangles; ") +
            std::to_string(behind) + " bytes behind them, " + std::to_string(behind / record) +
            " triangles more, are not read");
    result_.scene.groups.emplace_back("default");
    for (std::size_t t = 0; t < count; ++t) {
        constexpr std::size_t normal_bytes = 12;
        const std::size_t begin = header + count_bytes + t * record + normal_bytes;
        std::array<Vec3, 3> corners{};
        for (std::size_t k = 0; k < 9; ++k) {
            const auto value = std::bit_cast<float>(word_at(content, begin + 4 * k));
            if (!std::isfinite(value))
                fail_at_byte(begin + 4 * k, "expected a finite number");
            corners[k / 3][static_cast<int>(k % 3)] = value;
        }
        add_triangle(corners);
    }
}

void StlReader::read_text(std::string content) {
    TextReader reader(std::move(content));
    Statement statement;
    std::size_t line = 1;
    while (reader.next(statement)) {
        read_statement(statement);
        line = statement.line;
    }
    if (!corners_.empty())
        throw InputError(path_, line, "expected endfacet before the end of the file");
}

void StlReader::read_statement(const Statement& statement) {
    const std::string keyword = small_letters(statement.keyword);
    if (keyword == "vertex") {
        read_corner(statement);
    } else if (keyword == "endfacet") {
        end_facet(statement);
    } else if (keyword == "solid") {
        const std::string name(name_in(statement.rest));
        group_ = static_cast<std::uint32_t>(result_.scene.groups.size());
        result_.scene.groups.push_back(name.empty() ? "default" : name);
    } else if (keyword != "facet" && keyword != "outer" && keyword != "endloop" &&
               keyword != "endsolid") {
        throw InputError(path_, statement.line,
                         "expected solid, facet, outer, vertex, endloop, endfacet or endsolid, " +
                             found_instead(statement.keyword));
    }
}

void StlReader::read_corner(const Statement& statement) {
    const Vec3 corner = point_of(statement, path_);
    if (corners_.size() == 3)
        throw InputError(path_, statement.line, "expected 3 vertices in a facet, found a fourth");
    corners_.push_back(corner);
}

void StlReader::end_facet(const Statement& statement) {
    if (corners_.size() != 3)
        throw InputError(path_, statement.line,
                         "expected 3 vertices in a facet, found " +
                             std::to_string(corners_.size()));
    result_.face_lines.push_back(static_cast<std::uint32_t>(statement.line));
    add_triangle({corners_[0], corners_[1], corners_[2]});
    corners_.clear();
}

void StlReader::add_triangle(const std::array<Vec3, 3>& corners) {
    const std::uint32_t face = result_.scene.faces++;
    if (division_.divide(corners).degenerate) {
        ++result_.degenerate_faces;
        return;
    }
    const std::uint32_t a = vertex_at(corners[0]), b = vertex_at(corners[1]),
                        c = vertex_at(corners[2]);
    result_.scene.facets.push_back({{a, b, c, c}, face, 0, group_});
}

/// Corners at one place are one vertex, as the format repeats them.
std::uint32_t StlReader::vertex_at(const Vec3& place) {
    const auto next = static_cast<std::uint32_t>(result_.scene.vertices.size());
    const auto [found, is_new] = vertices_.try_emplace(place, next);
    if (is_new)
        result_.scene.vertices.push_back(place);
    return found->second;
}

} // namespace

ReadResult read_stl(const std::string& path, const ReadGuard& guard) {
    return StlReader(path, guard).read();
}

} // namespace hemilux
