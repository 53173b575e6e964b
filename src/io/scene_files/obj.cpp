#include "io/scene_files/obj.h"

#include "geometry/box.h"
#include "io/files/error.h"
#include "io/files/text_reader.h"
#include "io/scene_files/material_table.h"
#include "io/scene_files/obj_statements.h"
#include "radiosity/light/polygons/polygon_division.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <span>

namespace hemilux {
namespace {

/// Makes a scene of what the file says.
class ObjReader {
  public:
    ObjReader(const std::string& path, const ReadGuard& guard, bool textures, Outside outside)
        : path_(path), guard_(guard), textures_(textures), materials_(
                                                               path, result_,
                                                               [this](double bytes) {
                                                                   libraries_ += bytes;
                                                                   check_memory();
                                                               },
                                                               textures, outside) {}
    ReadResult read();

  private:
    void add_texcoords();
    void divide_faces();
    void check_corners() const;
    void warn(const LineTally& tally, const std::string& one, const std::string& many);
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
    ReadResult result_;
    MaterialTable materials_;
    ObjContents contents_;
    std::vector<std::size_t> corners_of_facets_; ///< four each, in the corners of the contents

    PolygonDivision division_;
    std::vector<Vec3> shape_;
    LineTally few_corners_, no_area_, crossing_, unchecked_;
};

ReadResult ObjReader::read() {
    std::string text = read_text_file(path_, InputKind::stream);
    text_ = static_cast<double>(text.size());
    TextReader reader(std::move(text));
    ObjStatements statements(path_, textures_, materials_, contents_);
    Statement statement;
    while (reader.next(statement)) {
        statements.read(statement);
        count_statement();
    }
    if (contents_.faces.empty() && contents_.capitals.count > 0)
        throw InputError(path_, contents_.capitals.first_line,
                         "no faces; expected keywords in small letters such as v and f, this one "
                         "has capitals");
    if (contents_.faces.empty())
        throw InputError(path_, "no faces; expected an OBJ file with statements such as f 1 2 3");
    result_.scene.vertices = std::move(contents_.vertices);
    result_.scene.groups = std::move(contents_.groups);
    check_corners();
    divide_faces();
    if (result_.scene.facets.empty())
        throw InputError(path_, "none of the faces has an area" + rounding_of_places());
    collect_warnings();
    return std::move(result_);
}

/// Adds the texture coordinates of all facets, once it is known that some carry a texture.
void ObjReader::add_texcoords() {
    Scene& scene = result_.scene;
    if (textures_of(scene).of_material.empty())
        return;
    std::vector<Texcoords>& of_facets = own_textures_of(scene).texcoords.emplace_back();
    std::size_t missing = 0;
    for (std::size_t f = 0; f < scene.facets.size(); ++f) {
        Texcoords& facet = of_facets.emplace_back();
        bool all = true;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t t = contents_.texcoord_of_corner[corners_of_facets_[4 * f + k]];
            all &= t < contents_.texcoords.size();
            facet[k] = t < contents_.texcoords.size() ? contents_.texcoords[t] : glm::vec2(0.0f);
        }
        missing += !all && scene.colours_vary_on(scene.facets[f].material);
    }
    if (missing > 0)
        result_.warnings.push_back(
            path_ + ": textured faces without texture coordinates: " + std::to_string(missing));
}

void ObjReader::check_corners() const {
    const std::size_t count = result_.scene.vertices.size();
    for (std::size_t f = 0; f < contents_.faces.size(); ++f)
        for (const std::uint32_t vertex : contents_.corners_of(f))
            if (vertex >= count)
                throw InputError(path_, contents_.faces[f].line,
                                 "expected a vertex between 1 and " + std::to_string(count) +
                                     ", the number of vertices, found " +
                                     std::to_string(std::uint64_t{vertex} + 1));
}

void ObjReader::divide_faces() {
    result_.scene.faces = static_cast<std::uint32_t>(contents_.faces.size());
    result_.scene.facets.reserve(contents_.faces.size());
    for (const ObjContents::Face& face : contents_.faces)
        result_.face_lines.push_back(static_cast<std::uint32_t>(face.line));
    for (std::uint32_t f = 0; f < contents_.faces.size(); ++f) {
        const ObjContents::Face& face = contents_.faces[f];
        const std::span<const std::uint32_t> corner = contents_.corners_of(f);
        shape_.clear();
        for (const std::uint32_t vertex : corner)
            shape_.push_back(result_.scene.vertices[vertex]);
        const PolygonFlags flags = division_.divide(shape_);
        for (const PolygonDivision::Piece& p : division_.pieces()) {
            if (textures_)
                for (const std::uint32_t k : p)
                    corners_of_facets_.push_back(face.first_corner + k);
            result_.scene.facets.push_back(
                {{corner[p[0]], corner[p[1]], corner[p[2]], corner[p[3]]},
                 f,
                 face.material,
                 face.group});
        }
        result_.degenerate_faces += flags.degenerate;
        result_.nonplanar_faces += flags.nonplanar;
        result_.concave_faces += flags.concave;
        if (corner.size() < 3)
            few_corners_.add(face.line);
        else if (flags.degenerate)
            no_area_.add(face.line);
        if (flags.crossing)
            crossing_.add(face.line);
        if (flags.unchecked)
            unchecked_.add(face.line);
        if (flags.unfinished)
            throw InputError(path_, face.line,
                             "a face of " + std::to_string(corner.size()) +
                                 " corners is too intricate to be divided into triangles; expected "
                                 "a face that does not cross itself, or smaller faces");
        count_statement();
    }
}

void ObjReader::warn(const LineTally& tally, const std::string& one, const std::string& many) {
    if (tally.count == 1)
        result_.warnings.push_back(path_ + ":" + std::to_string(tally.first_line) + ": " + one);
    else if (tally.count > 1)
        result_.warnings.push_back(path_ + ":" + std::to_string(tally.first_line) + ": " +
                                   std::to_string(tally.count) + " " + many +
                                   " (this is the first)");
}

/// Calls the guard with the memory in use. A vector that grows keeps the old one until the new one
/// is filled.
void ObjReader::check_memory() const {
    if (!guard_)
        return;
    constexpr double growing = 1.5, per_group = 160;
    const auto bytes = [](const auto& list) {
        return growing * static_cast<double>(list.capacity() * sizeof(list[0]));
    };
    guard_(text_ + libraries_ + bytes(contents_.corners) + bytes(contents_.texcoords) +
           bytes(contents_.texcoord_of_corner) + bytes(corners_of_facets_) +
           bytes(contents_.faces) + bytes(contents_.vertices) + bytes(result_.scene.vertices) +
           bytes(result_.scene.facets) +
           per_group * static_cast<double>(contents_.groups.size() + result_.scene.groups.size() +
                                           result_.scene.materials.size()));
}

/// Returns a warning where the scene is so far from the origin that doubles hardly distinguish its
/// places from each other; else nothing.
std::string ObjReader::rounding_of_places() const {
    constexpr double noticeable = 1e-7; // of the scene's size
    Box bounds;
    for (const std::uint32_t corner : contents_.corners)
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
    warn(contents_.lines_and_points, "a line or point is left out",
         "lines and points are left out");
    warn(contents_.capitals, "a statement whose keyword has capitals is left out",
         "statements whose keywords have capitals are left out");
    warn(contents_.odd_texcoords, "a texture coordinate is no number within 1e6; it is 0 here",
         "texture coordinates are no numbers within 1e6; they are 0 here");
    warn(contents_.coloured, "a vertex has a colour, which is not read",
         "vertices have colours, which are not read");
    warn(contents_.free_form, "a statement of a free-form curve or surface is left out",
         "statements of free-form curves and surfaces are left out");
}

} // namespace

ReadResult read_obj(const std::string& path, const ReadGuard& guard, bool textures,
                    Outside outside) {
    return ObjReader(path, guard, textures, outside).read();
}

} // namespace hemilux
