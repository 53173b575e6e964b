#include "io/scene_files/obj.h"

#include "geometry/box.h"
#include "io/files/error.h"
#include "io/files/text_reader.h"
#include "io/files/text_words.h"
#include "io/scene_files/material_table.h"
#include "io/scene_files/polygon_division.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <unordered_map>

namespace hemilux {
namespace {

constexpr const char* default_name = "default";
constexpr std::uint32_t unresolved = 0xffffffff;

constexpr std::array<std::string_view, 15> free_form_keywords{
    "curv", "curv2", "surf", "vp",   "cstype", "deg", "bmat", "step",
    "parm", "trim",  "hole", "scrv", "sp",     "end", "con"};

/// A face as it stands in the file.
struct RawFace {
    std::size_t first_corner;
    std::size_t line;
    std::uint32_t material, group;
};

/// How often something occurred, and where first.
struct Tally {
    std::size_t count = 0, first_line = 0;
    void add(std::size_t line) {
        if (count++ == 0)
            first_line = line;
    }
};

class ObjReader {
  public:
    ObjReader(const std::string& path, const ReadGuard& guard, bool textures)
        : path_(path), guard_(guard), textures_(textures), materials_(
                                                               path,
                                                               [this](double bytes) {
                                                                   libraries_ += bytes;
                                                                   check_memory();
                                                               },
                                                               textures) {}
    ReadResult read();

  private:
    void read_statement(const Statement& statement);
    void read_vertex(const Statement& statement);
    void read_face(const Statement& statement);
    void read_texcoord(const Statement& statement);
    void read_corner(std::string_view word, std::size_t line);
    void add_texcoords();
    void read_group(std::string_view names);
    void resolve_names();
    void divide_faces();
    void check_corners() const;
    std::span<const std::uint32_t> corners_of(std::size_t face) const;
    void warn(const Tally& tally, const std::string& one, const std::string& many);
    void collect_warnings();
    void check_memory() const;
    void count_statement() {
        constexpr std::size_t often = 1u << 12;
        if (++statements_ % often == 0)
            check_memory();
    }
    std::string rounding_of_places() const;

    std::string path_;
    const ReadGuard& guard_;
    bool textures_;
    double text_ = 0, libraries_ = 0; ///< bytes
    std::size_t statements_ = 0;
    MaterialTable materials_;
    std::unordered_map<std::string, std::uint32_t> group_index_;
    std::vector<std::uint32_t> corners_;
    std::vector<glm::vec2> texcoords_;
    std::vector<std::uint32_t> texcoord_of_corner_; ///< unresolved: none
    std::vector<std::size_t> corners_of_facets_;    ///< four each, in corners_
    std::vector<RawFace> faces_;
    ReadResult result_;

    std::string material_name_ = default_name, group_name_ = default_name;
    std::size_t material_line_ = 0;
    std::uint32_t material_ = unresolved, group_ = unresolved; ///< of those names

    PolygonDivision division_;
    std::vector<Vec3> shape_;
    Tally few_corners_, no_area_, crossing_, unchecked_, free_form_, lines_and_points_, capitals_,
        odd_texcoords_;
};

ReadResult ObjReader::read() {
    std::string text = read_text_file(path_, InputKind::stream);
    text_ = static_cast<double>(text.size());
    TextReader reader(std::move(text));
    Statement statement;
    while (reader.next(statement)) {
        read_statement(statement);
        count_statement();
    }
    if (faces_.empty() && capitals_.count > 0)
        throw InputError(path_, capitals_.first_line,
                         "no faces; expected keywords in small letters such as v and f, this one "
                         "has capitals");
    if (faces_.empty())
        throw InputError(path_, "no faces; expected an OBJ file with statements such as f 1 2 3");
    check_corners();
    divide_faces();
    if (result_.scene.facets.empty())
        throw InputError(path_, "none of the faces has an area" + rounding_of_places());
    collect_warnings();
    return std::move(result_);
}

void ObjReader::read_statement(const Statement& statement) {
    const std::string_view keyword = statement.keyword;
    if (keyword == "v") {
        read_vertex(statement);
    } else if (keyword == "f" || keyword == "fo") { // fo: of old files
        read_face(statement);
    } else if (keyword == "g" || keyword == "o") {
        read_group(statement.rest);
    } else if (keyword == "usemtl") {
        material_name_ = name_in(statement.rest);
        material_line_ = statement.line;
        material_ = unresolved;
    } else if (keyword == "mtllib") {
        materials_.read_libraries(statement.rest, statement.line);
    } else if (keyword == "p" || keyword == "l") {
        lines_and_points_.add(statement.line);
    } else if (keyword == "vt") {
        if (textures_)
            read_texcoord(statement);
    } else if (keyword != "vn") {
        for (const std::string_view free_form : free_form_keywords)
            if (keyword == free_form)
                free_form_.add(statement.line);
        for (const char* known : {"v", "f", "g", "o", "usemtl", "mtllib"})
            if (differ_in_case(keyword, known))
                capitals_.add(statement.line);
    }
}

void ObjReader::read_vertex(const Statement& statement) {
    result_.scene.vertices.push_back(point_of(statement, path_));
}

void ObjReader::read_face(const Statement& statement) {
    resolve_names();
    faces_.push_back({corners_.size(), statement.line, material_, group_});
    std::string_view rest = statement.rest;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
        read_corner(word, statement.line);
    if (corners_.size() == faces_.back().first_corner)
        throw InputError(path_, statement.line,
                         "expected three or more vertices after f, " + found_instead(""));
}

/// v, v/t, v//n or v/t/n; v and t count from 1, or backwards from the last one so far where
/// negative. v may be of a vertex to come: check_corners. A texture coordinate that does not exist
/// is none.
void ObjReader::read_corner(std::string_view word, std::size_t line) {
    const char* at = word.data();
    const char* const end = at + word.size();
    std::int64_t vertex = 0;
    std::array<std::int64_t, 2> others{}; // of coordinates and normals
    const std::from_chars_result parsed = std::from_chars(at, end, vertex);
    at = parsed.ptr;
    for (std::size_t slash = 0; slash < 2 && at != end && *at == '/'; ++slash)
        at = std::from_chars(at + 1, end, others.at(slash)).ptr;
    if (parsed.ec == std::errc::invalid_argument || at != end)
        throw InputError(path_, line,
                         "expected a vertex such as 1, 1/2, 1//3 or 1/2/3, " + found_instead(word));
    const auto count = static_cast<std::int64_t>(result_.scene.vertices.size());
    const std::int64_t index = vertex < 0 ? vertex + count : vertex - 1;
    if (parsed.ec != std::errc() || vertex == 0 || index < 0 || index >= unresolved)
        throw InputError(path_, line,
                         "expected a vertex between 1 and the number of vertices (" +
                             std::to_string(count) + " so far), " + found_instead(word));
    corners_.push_back(static_cast<std::uint32_t>(index));
    if (!textures_)
        return;
    const auto coordinates = static_cast<std::int64_t>(texcoords_.size());
    const std::int64_t t = others[0] < 0 ? others[0] + coordinates : others[0] - 1;
    texcoord_of_corner_.push_back(t >= 0 && t < unresolved ? static_cast<std::uint32_t>(t)
                                                           : unresolved);
}

/// Coordinates that are no numbers are 0: they matter where a texture is.
void ObjReader::read_texcoord(const Statement& statement) {
    std::string_view rest = statement.rest;
    glm::vec2 place(0.0f);
    bool is_odd = false;
    for (int axis = 0; axis < 2; ++axis) {
        const std::optional<double> number = parse_decimal(take_word(rest));
        constexpr double most = 1e6;
        const bool is_place = number && std::abs(*number) <= most;
        place[axis] = is_place ? static_cast<float>(*number) : 0.0f;
        is_odd = is_odd || !is_place;
    }
    if (is_odd)
        odd_texcoords_.add(statement.line);
    texcoords_.push_back(place);
}

/// Of all facets, once it is known that some carry a texture.
void ObjReader::add_texcoords() {
    Scene& scene = result_.scene;
    if (materials_.maps.empty())
        return;
    scene.textures.of_material = std::move(materials_.maps);
    scene.textures.of_material.resize(scene.materials.size());
    std::vector<Texcoords>& of_facets = scene.textures.texcoords.emplace_back();
    std::size_t missing = 0;
    for (std::size_t f = 0; f < scene.facets.size(); ++f) {
        Texcoords& facet = of_facets.emplace_back();
        bool all = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t t = texcoord_of_corner_[corners_of_facets_[4 * f + k]];
            all &= t < texcoords_.size();
            facet[k] = t < texcoords_.size() ? texcoords_[t] : glm::vec2(0.0f);
        }
        missing += !all && scene.textures.on(scene.facets[f].material);
    }
    if (missing > 0)
        result_.warnings.push_back(
            path_ + ": textured faces without texture coordinates: " + std::to_string(missing));
}

void ObjReader::read_group(std::string_view names) {
    std::string_view rest = name_in(names);
    group_name_.clear();
    for (; !rest.empty(); rest = trimmed(rest)) {
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t\v\f"));
        group_name_ += (group_name_.empty() ? "" : " ") + std::string(word);
        rest.remove_prefix(word.size());
    }
    group_ = unresolved;
}

/// Names are entered when a face uses them first.
void ObjReader::resolve_names() {
    if (material_ == unresolved) {
        const bool is_default = material_name_.empty() || material_name_ == default_name;
        material_ = is_default ? materials_.use(default_name, 0)
                               : materials_.use(material_name_, material_line_);
    }
    if (group_ == unresolved) {
        std::vector<std::string>& groups = result_.scene.groups;
        const std::string& name = group_name_.empty() ? default_name : group_name_;
        const auto [found, is_new] =
            group_index_.try_emplace(name, static_cast<std::uint32_t>(groups.size()));
        if (is_new)
            groups.push_back(name);
        group_ = found->second;
    }
}

std::span<const std::uint32_t> ObjReader::corners_of(std::size_t face) const {
    const std::size_t begin = faces_[face].first_corner;
    const std::size_t end =
        face + 1 < faces_.size() ? faces_[face + 1].first_corner : corners_.size();
    return std::span(corners_).subspan(begin, end - begin);
}

void ObjReader::check_corners() const {
    const std::size_t count = result_.scene.vertices.size();
    for (std::size_t f = 0; f < faces_.size(); ++f)
        for (const std::uint32_t vertex : corners_of(f))
            if (vertex >= count)
                throw InputError(path_, faces_[f].line,
                                 "expected a vertex between 1 and " + std::to_string(count) +
                                     ", the number of vertices, found " +
                                     std::to_string(std::uint64_t{vertex} + 1));
}

void ObjReader::divide_faces() {
    result_.scene.faces = static_cast<std::uint32_t>(faces_.size());
    result_.scene.facets.reserve(faces_.size());
    for (const RawFace& face : faces_)
        result_.face_lines.push_back(static_cast<std::uint32_t>(face.line));
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        const std::span<const std::uint32_t> corner = corners_of(f);
        shape_.clear();
        for (const std::uint32_t vertex : corner)
            shape_.push_back(result_.scene.vertices[vertex]);
        const PolygonFlags flags = division_.divide(shape_);
        for (const PolygonDivision::Piece& p : division_.pieces()) {
            if (textures_)
                for (const std::uint32_t k : p)
                    corners_of_facets_.push_back(faces_[f].first_corner + k);
            result_.scene.facets.push_back(
                {{corner[p[0]], corner[p[1]], corner[p[2]], corner[p[3]]},
                 f,
                 faces_[f].material,
                 faces_[f].group});
        }
        result_.degenerate_faces += flags.degenerate;
        result_.nonplanar_faces += flags.nonplanar;
        result_.concave_faces += flags.concave;
        if (corner.size() < 3)
            few_corners_.add(faces_[f].line);
        else if (flags.degenerate)
            no_area_.add(faces_[f].line);
        if (flags.crossing)
            crossing_.add(faces_[f].line);
        if (flags.unchecked)
            unchecked_.add(faces_[f].line);
        if (flags.unfinished)
            throw InputError(path_, faces_[f].line,
                             "a face of " + std::to_string(corner.size()) +
                                 " corners is too intricate to be divided into triangles; expected "
                                 "a face that does not cross itself, or smaller faces");
        count_statement();
    }
}

void ObjReader::warn(const Tally& tally, const std::string& one, const std::string& many) {
    if (tally.count == 1)
        result_.warnings.push_back(path_ + ":" + std::to_string(tally.first_line) + ": " + one);
    else if (tally.count > 1)
        result_.warnings.push_back(path_ + ":" + std::to_string(tally.first_line) + ": " +
                                   std::to_string(tally.count) + " " + many +
                                   " (this is the first)");
}

/// A vector that grows keeps the old one until the new one is filled.
void ObjReader::check_memory() const {
    if (!guard_)
        return;
    constexpr double growing = 1.5, per_group = 160;
    const auto bytes = [](const auto& list) {
        return growing * static_cast<double>(list.capacity() * sizeof(list[0]));
    };
    guard_(text_ + libraries_ + bytes(corners_) + bytes(texcoords_) + bytes(texcoord_of_corner_) +
           bytes(corners_of_facets_) + bytes(faces_) + bytes(result_.scene.vertices) +
           bytes(result_.scene.facets) +
           per_group *
               static_cast<double>(result_.scene.groups.size() + materials_.materials.size()));
}

/// What there is to say where doubles hardly tell the scene's places from each other, because it is
/// so far from the origin; else nothing.
std::string ObjReader::rounding_of_places() const {
    constexpr double noticeable = 1e-7; // of the scene's size
    Box bounds;
    for (const std::uint32_t corner : corners_)
        bounds.include(result_.scene.vertices[corner]);
    const auto largest_of = [](const Vec3& v) { return std::max({v.x, v.y, v.z}); };
    const double farthest = largest_of(glm::max(glm::abs(bounds.low), glm::abs(bounds.high)));
    const double spacing = std::numeric_limits<double>::epsilon() * farthest;
    const double size = largest_of(bounds.extent());
    if (!(spacing > noticeable * size))
        return "";
    std::array<char, 200> text{};
    std::snprintf(text.data(), text.size(),
                  ": all lies near %.2g, where numbers are rounded to %.2g, and is %.2g wide; move "
                  "it nearer to the origin",
                  farthest, spacing, size);
    return text.data();
}

void ObjReader::collect_warnings() {
    materials_.finish();
    result_.scene.materials = std::move(materials_.materials);
    result_.material_source = std::move(materials_.sources);
    result_.warnings = std::move(materials_.warnings);
    result_.libraries = std::move(materials_.libraries);
    result_.textures = std::move(materials_.textures);
    add_texcoords();
    if (const std::string rounding = rounding_of_places(); !rounding.empty())
        result_.warnings.push_back(path_ + rounding);
    warn(few_corners_, "a face with fewer than 3 corners is left out",
         "faces with fewer than 3 corners are left out");
    warn(no_area_, "a face without area is left out", "faces without area are left out");
    warn(crossing_, "a face crosses itself; its area is not well defined",
         "faces cross themselves; their areas are not well defined");
    warn(unchecked_,
         "a face has so many long edges that it was not found out whether it crosses itself",
         "faces have so many long edges that it was not found out whether they cross themselves");
    warn(lines_and_points_, "a line or point is left out", "lines and points are left out");
    warn(capitals_, "a statement whose keyword has capitals is left out",
         "statements whose keywords have capitals are left out");
    warn(odd_texcoords_, "a texture coordinate is no number within 1e6; it is 0 here",
         "texture coordinates are no numbers within 1e6; they are 0 here");
    warn(free_form_, "a statement of a free-form curve or surface is left out",
         "statements of free-form curves and surfaces are left out");
}

} // namespace

ReadResult read_obj(const std::string& path, const ReadGuard& guard, bool textures) {
    return ObjReader(path, guard, textures).read();
}

} // namespace hemilux
