#include "io/scene_files/obj_statements.h"

#include "io/files/error.h"
#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace hemilux {
namespace {

constexpr std::array<std::string_view, 15> free_form_keywords{
    "curv", "curv2", "surf", "vp",   "cstype", "deg", "bmat", "step",
    "parm", "trim",  "hole", "scrv", "sp",     "end", "con"};

/// Returns whether a colour follows the three coordinates of a vertex: six words or more.
bool has_colour(std::string_view rest) {
    constexpr std::size_t words_with_colour = 6;
    constexpr std::string_view blanks = " \t\v\f";
    std::size_t words = 0, at = 0;
    while (words < words_with_colour && (at = rest.find_first_not_of(blanks, at)) < rest.size()) {
        if (rest[at] == '#')
            return false;
        ++words;
        at = rest.find_first_of(blanks, at);
    }
    return words == words_with_colour;
}

} // namespace

void ObjStatements::read(const Statement& statement) {
    const std::string_view keyword = statement.keyword;
    if (keyword == "v") {
        contents_.vertices.push_back(point_of(statement, path_));
        if (has_colour(statement.rest))
            contents_.coloured.add(statement.line);
    } else if (keyword == "f" || keyword == "fo") { // fo: of old files
        read_face(statement);
    } else if (keyword == "g" || keyword == "o") {
        read_group(statement.rest);
    } else if (keyword == "usemtl") {
        material_name_ = name_in(statement.rest);
        material_line_ = statement.line;
        material_ = none;
    } else if (keyword == "mtllib") {
        materials_.read_libraries(statement.rest, statement.line);
    } else if (keyword == "p" || keyword == "l") {
        contents_.lines_and_points.add(statement.line);
    } else if (keyword == "vt") {
        if (textures_)
            read_texcoord(statement);
    } else if (keyword != "vn") {
        for (const std::string_view free_form : free_form_keywords)
            if (keyword == free_form)
                contents_.free_form.add(statement.line);
        for (const char* known : {"v", "f", "g", "o", "usemtl", "mtllib"})
            if (differ_in_case(keyword, known))
                contents_.capitals.add(statement.line);
    }
}

void ObjStatements::read_face(const Statement& statement) {
    resolve_names();
    contents_.faces.push_back({contents_.corners.size(), statement.line, material_, group_});
    std::string_view rest = statement.rest;
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
        read_corner(word, statement.line);
    if (contents_.corners.size() == contents_.faces.back().first_corner)
        throw InputError(path_, statement.line,
                         "expected three or more vertices after f, " + found_instead(""));
}

/// Reads a corner: v, v/t, v//n or v/t/n. The numbers v and t count from 1 or, where negative,
/// backwards from the last one so far. The vertex v may be one to come, which check_corners looks
/// at. A texture coordinate that does not exist is none.
void ObjStatements::read_corner(std::string_view word, std::size_t line) {
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
    const auto count = static_cast<std::int64_t>(contents_.vertices.size());
    const std::int64_t index = vertex < 0 ? vertex + count : vertex - 1;
    if (parsed.ec != std::errc() || vertex == 0 || index < 0 || index >= none)
        throw InputError(path_, line,
                         "expected a vertex between 1 and the number of vertices (" +
                             std::to_string(count) + " so far), " + found_instead(word));
    contents_.corners.push_back(static_cast<std::uint32_t>(index));
    if (!textures_)
        return;
    const auto coordinates = static_cast<std::int64_t>(contents_.texcoords.size());
    const std::int64_t t = others[0] < 0 ? others[0] + coordinates : others[0] - 1;
    contents_.texcoord_of_corner.push_back(t >= 0 && t < ObjContents::no_texcoord
                                               ? static_cast<std::uint32_t>(t)
                                               : ObjContents::no_texcoord);
}

/// Coordinates that are no numbers are 0: they matter where a texture is.
void ObjStatements::read_texcoord(const Statement& statement) {
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
        contents_.odd_texcoords.add(statement.line);
    contents_.texcoords.push_back(place);
}

void ObjStatements::read_group(std::string_view names) {
    std::string_view rest = name_in(names);
    group_name_.clear();
    for (; !rest.empty(); rest = trimmed(rest)) {
        const std::string_view word = rest.substr(0, rest.find_first_of(" \t\v\f"));
        group_name_ += (group_name_.empty() ? "" : " ") + std::string(word);
        rest.remove_prefix(word.size());
    }
    group_ = none;
}

/// Names are entered when a face uses them first.
void ObjStatements::resolve_names() {
    if (material_ == none) {
        const bool is_default = material_name_.empty() || material_name_ == default_name;
        material_ = is_default ? materials_.use(default_name, 0)
                               : materials_.use(material_name_, material_line_);
    }
    if (group_ == none) {
        std::vector<std::string>& groups = contents_.groups;
        const std::string& name = group_name_.empty() ? default_name : group_name_;
        const auto [found, is_new] =
            group_index_.try_emplace(name, static_cast<std::uint32_t>(groups.size()));
        if (is_new)
            groups.push_back(name);
        group_ = found->second;
    }
}

} // namespace hemilux
