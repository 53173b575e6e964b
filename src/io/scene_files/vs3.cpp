#include "io/scene_files/vs3.h"

#include "io/files/error.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "radiosity/light/polygons/polygon_division.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace hemilux {
namespace {

class Vs3Reader {
  public:
    Vs3Reader(const std::string& path, const ReadGuard& guard) : path_(path), guard_(guard) {}
    ReadResult read();

  private:
    struct Surface {
        std::uint32_t line, face;
        long number;
        std::string name = {};
        std::uint32_t group = 0, material = 0;
        std::vector<std::uint32_t> corners = {};
    };

    void read_statement(const Statement& statement);
    void read_vertex(const Statement& statement);
    void read_surface(const Statement& statement);
    void add(const Surface& surface);
    void name_groups();
    [[nodiscard]] long number_in(const Statement& statement, std::string_view& rest,
                                 const char* what) const;
    [[nodiscard]] const Surface& surface_before(const Statement& statement, long number) const;
    [[nodiscard]] std::uint32_t material_of(double emittance, std::string_view word);
    [[noreturn]] void fail(std::size_t line, const std::string& message) const {
        throw InputError(path_, line, message);
    }

    std::string path_;
    const ReadGuard& guard_;
    std::unordered_map<long, std::uint32_t> vertices_;
    std::unordered_map<long, std::size_t> numbers_; ///< of surfaces
    std::map<double, std::uint32_t> materials_;
    std::vector<Surface> surfaces_;
    bool has_kind_ = false;
    std::size_t obstructions_ = 0;
    PolygonDivision division_;
    ReadResult result_;
};

long Vs3Reader::number_in(const Statement& statement, std::string_view& rest,
                          const char* what) const {
    const std::string_view word = take_word(rest);
    long number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() || number < 0)
        fail(statement.line, std::string("expected ") + what + ", " + found_instead(word));
    return number;
}

const Vs3Reader::Surface& Vs3Reader::surface_before(const Statement& statement, long number) const {
    const auto found = numbers_.find(number);
    if (found == numbers_.end())
        fail(statement.line,
             "expected 0 or a surface that stands before, found " + std::to_string(number));
    return surfaces_[found->second];
}

std::uint32_t Vs3Reader::material_of(double emittance, std::string_view word) {
    const auto next = static_cast<std::uint32_t>(result_.scene.materials.size());
    const auto [found, is_new] = materials_.try_emplace(emittance, next);
    if (is_new) {
        Material& material = result_.scene.materials.emplace_back();
        material.name = "emittance " + std::string(word);
        material.reflectance = Vec3(1 - emittance);
        result_.material_source.emplace_back();
    }
    return found->second;
}

void Vs3Reader::read_vertex(const Statement& statement) {
    std::string_view rest = statement.rest;
    const long number = number_in(statement, rest, "the number of a vertex");
    const Vec3 place = point_of({statement.keyword, rest, statement.line}, path_);
    const auto next = static_cast<std::uint32_t>(result_.scene.vertices.size());
    if (!vertices_.try_emplace(number, next).second)
        fail(statement.line, "expected a vertex of another number: there is a vertex " +
                                 std::to_string(number) + " before");
    result_.scene.vertices.push_back(place);
}

void Vs3Reader::read_surface(const Statement& statement) {
    std::string_view rest = statement.rest;
    Surface surface{.line = static_cast<std::uint32_t>(statement.line),
                    .face = static_cast<std::uint32_t>(surfaces_.size()),
                    .number = number_in(statement, rest, "the number of a surface")};
    for (int k = 0; k < 4; ++k) {
        const long corner = number_in(statement, rest, "the number of a vertex");
        if (corner == 0 && k == 3)
            break;
        const auto found = vertices_.find(corner);
        if (found == vertices_.end())
            fail(statement.line,
                 "expected a vertex that stands before, found " + std::to_string(corner));
        surface.corners.push_back(found->second);
    }
    surface.group = surface.face;
    if (number_in(statement, rest, "the number of a base surface, or 0") != 0)
        fail(statement.line, "expected 0 as base: a surface that lies on another is not cut out of "
                             "it; write sections around it, and combine them");
    if (const long other = number_in(statement, rest, "the number of a surface to combine with"))
        surface.group = surface_before(statement, other).group;
    const std::string_view word = take_word(rest);
    const std::optional<double> emittance = parse_decimal(word);
    if (!emittance || !(*emittance >= 0 && *emittance <= 1))
        fail(statement.line, "expected an emittance from 0 to 1, " + found_instead(word));
    surface.material = material_of(*emittance, word);
    surface.name = name_in(rest);
    if (surface.name.empty())
        surface.name = "surface " + std::to_string(surface.number);
    if (!numbers_.try_emplace(surface.number, surfaces_.size()).second)
        fail(statement.line, "expected a surface of another number: there is a surface " +
                                 std::to_string(surface.number) + " before");
    surfaces_.push_back(std::move(surface));
}

void Vs3Reader::read_statement(const Statement& statement) {
    const std::string keyword = small_letters(statement.keyword);
    if (keyword == "v") {
        read_vertex(statement);
    } else if (keyword == "s" || keyword == "o") {
        read_surface(statement);
        obstructions_ += keyword == "o";
    } else if (keyword == "f") {
        std::string_view rest = statement.rest;
        const std::string_view kind = take_word(rest);
        if (kind != "3")
            fail(statement.line,
                 "expected F 3, geometry by vertices in three dimensions, " + found_instead(kind));
        has_kind_ = true;
    } else if (keyword != "t" && keyword != "c") {
        fail(statement.line,
             "expected T, C, F, V, S, O or End, " + found_instead(statement.keyword));
    }
}

/// Surfaces of one name that are not combined keep apart by their numbers.
void Vs3Reader::name_groups() {
    std::unordered_map<std::string, std::size_t> times;
    for (const Surface& surface : surfaces_)
        ++times[surface.name];
    for (const Surface& surface : surfaces_)
        result_.scene.groups.push_back(times[surface.name] > 1
                                           ? surface.name + " " + std::to_string(surface.number)
                                           : surface.name);
}

void Vs3Reader::add(const Surface& surface) {
    std::vector<Vec3> corners;
    for (const std::uint32_t vertex : surface.corners)
        corners.push_back(result_.scene.vertices[vertex]);
    result_.face_lines.push_back(surface.line);
    ++result_.scene.faces;
    const PolygonFlags flags = division_.divide(corners);
    result_.degenerate_faces += flags.degenerate;
    result_.nonplanar_faces += flags.nonplanar;
    result_.concave_faces += flags.concave;
    for (const PolygonDivision::Piece& piece : division_.pieces())
        result_.scene.facets.push_back({{surface.corners[piece[0]], surface.corners[piece[1]],
                                         surface.corners[piece[2]], surface.corners[piece[3]]},
                                        surface.face,
                                        surface.material,
                                        surface.group});
}

ReadResult Vs3Reader::read() {
    std::string content = read_text_file(path_, InputKind::stream);
    constexpr double bytes_per_byte = 8;
    if (guard_)
        guard_(bytes_per_byte * static_cast<double>(content.size()));
    // Its comments begin with another mark than those of the statements that are read here.
    for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        const std::size_t mark = content.find('!', at);
        if (mark < end)
            content.replace(mark, 1, "#");
        at = end + 1;
    }
    TextReader reader(std::move(content));
    for (Statement statement; reader.next(statement);) {
        if (small_letters(statement.keyword).starts_with("e"))
            break;
        read_statement(statement);
    }
    if (!has_kind_ && !surfaces_.empty())
        fail(surfaces_.front().line, "expected F 3 before the first surface");
    name_groups();
    for (const Surface& surface : surfaces_)
        add(surface);
    if (result_.scene.facets.empty())
        throw InputError(path_, surfaces_.empty() ? "no surfaces; expected a file of View3D"
                                                  : "none of the surfaces has an area");
    if (obstructions_ > 0)
        result_.warnings.push_back(path_ + ": obstructions (O) have factors as other surfaces: " +
                                   std::to_string(obstructions_));
    if (result_.degenerate_faces > 0)
        result_.warnings.push_back(path_ + ": surfaces without area are left out: " +
                                   std::to_string(result_.degenerate_faces));
    return std::move(result_);
}

} // namespace

ReadResult read_vs3(const std::string& path, const ReadGuard& guard) {
    return Vs3Reader(path, guard).read();
}

} // namespace hemilux
