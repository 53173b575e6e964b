#include "io/meshes/glb.h"

#include "io/files/little_endian.h"
#include "io/files/provenance.h"
#include "io/meshes/glb_container.h"
#include "radiosity/paper/scene/mesh.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>

namespace hemilux {
namespace {

using Json = nlohmann::ordered_json;

constexpr int float_component = 5126, uint_component = 5125; // names of OpenGL's constants
constexpr int vertex_target = 34962, index_target = 34963;
/// Position, colour and light of a vertex, one after the other, then its place in a lightmap.
constexpr std::size_t vector_bytes = 3 * sizeof(float), vectors_bytes = 3 * vector_bytes;
constexpr std::size_t texcoord_bytes = 2 * sizeof(float);

/// A mesh of one group.
struct Part {
    std::uint32_t group;
    std::vector<std::uint32_t> vertices; ///< classes of corners
    std::vector<std::uint32_t> indices;  ///< indices of vertices, three a triangle
};

/// The vertices of a group are numbered as they first occur in it.
std::vector<Part> parts_of(const Mesh& mesh, const CornerClasses& classes) {
    std::vector<std::vector<std::uint32_t>> patches(mesh.scene().groups.size());
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i)
        if (const Patch& patch = mesh.patches()[i]; !mesh.material(patch).is_far)
            patches[mesh.scene().facets[patch.facet].group].push_back(i);
    // These hold for each class the last group that had it, and its number there.
    std::vector<std::uint32_t> group_of(classes.position.size(), none), number(group_of.size());
    std::vector<Part> parts;
    for (std::uint32_t group = 0; group < patches.size(); ++group) {
        if (patches[group].empty())
            continue;
        Part& part = parts.emplace_back(Part{group, {}, {}});
        const auto add = [&](std::uint32_t vertex) {
            if (group_of[vertex] != group) {
                group_of[vertex] = group;
                number[vertex] = static_cast<std::uint32_t>(part.vertices.size());
                part.vertices.push_back(vertex);
            }
            part.indices.push_back(number[vertex]);
        };
        for (const std::uint32_t i : patches[group])
            for_each_triangle(classes, i, [&](auto... corners) { (add(corners), ...); });
    }
    return parts;
}

/// The JSON and the buffer of a file: all vertices, then all indices.
class Document {
  public:
    Document(const Mesh& mesh, const CornerClasses& classes, const VertexLight& light, int up,
             std::span<const Vec2> texcoords)
        : mesh_(mesh), classes_(classes), light_(light), up_(up), texcoords_(texcoords) {}

    void add(const Part& part) {
        const int first = static_cast<int>(accessors_.size());
        add_vertices(part);
        add_indices(part);
        std::string name = std::string("_") + name_of(light_.bake);
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
        const std::string& group = mesh_.scene().groups[part.group];
        const Vec3 centre = mesh_.frame().centre;
        nodes_.push_back({{"name", group},
                          {"mesh", meshes_.size()},
                          {"translation", {centre.x, centre.y, centre.z}}});
        if (up_ == 2) { // z to y, and y to -z: a quarter turn about x
            const double s = std::numbers::sqrt2 / 2;
            nodes_.back()["translation"] = {centre.x, centre.z, -centre.y};
            nodes_.back()["rotation"] = {-s, 0, 0, s};
        }
        Json attributes{{"POSITION", first}, {"COLOR_0", first + 1}, {name, first + 2}};
        if (!texcoords_.empty())
            attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] = first + 3;
        const Json primitive{
            {"attributes", attributes}, {"indices", accessors_.size() - 1}, {"material", 0}};
        meshes_.push_back({{"name", group}, {"primitives", Json::array({primitive})}});
    }

    [[nodiscard]] std::string json(const Provenance& from) const {
        Json asset{{"version", "2.0"}, {"generator", from.program}};
        if (!from.command.empty())
            asset["extras"] = {{"command", from.command}, {"seed", from.seed}};
        std::vector<std::size_t> roots;
        for (std::size_t node = 0; node < nodes_.size(); ++node)
            roots.push_back(node);
        const Json view_of_vertices{{"buffer", 0},
                                    {"byteOffset", 0},
                                    {"byteLength", vertices_.size()},
                                    {"byteStride", vertex_bytes()},
                                    {"target", vertex_target}};
        const Json view_of_indices{{"buffer", 0},
                                   {"byteOffset", vertices_.size()},
                                   {"byteLength", indices_.size()},
                                   {"target", index_target}};
        const Json scene{{"nodes", roots}, {"extras", {{"exposure", light_.display.exposure}}}};
        const Json unlit{{"name", "light"},
                         {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
        const Json buffer{{"byteLength", vertices_.size() + indices_.size()}};
        const Json all{{"asset", asset},
                       {"extensionsUsed", Json::array({"KHR_materials_unlit"})},
                       {"scene", 0},
                       {"scenes", Json::array({scene})},
                       {"nodes", nodes_},
                       {"meshes", meshes_},
                       {"materials", Json::array({unlit})},
                       {"accessors", accessors_},
                       {"bufferViews", Json::array({view_of_vertices, view_of_indices})},
                       {"buffers", Json::array({buffer})}};
        // A name that is not UTF-8 must not cost the user the file.
        return all.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    [[nodiscard]] const std::string& vertices() const { return vertices_; }
    [[nodiscard]] const std::string& indices() const { return indices_; }

  private:
    void add_vertices(const Part& part) {
        const std::size_t begin = vertices_.size();
        glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
        for (const std::uint32_t vertex : part.vertices) {
            const glm::vec3 position(classes_.position[vertex] / mesh_.frame().scale);
            const glm::vec3 light(light_.of_class[vertex]);
            low = glm::min(low, position);
            high = glm::max(high, position);
            append_numbers(vertices_, position);
            append_numbers(vertices_, light_.display(light));
            append_numbers(vertices_, light);
            if (texcoords_.empty())
                continue;
            append_number(vertices_, static_cast<float>(texcoords_[vertex].x));
            append_number(vertices_, static_cast<float>(texcoords_[vertex].y));
        }
        const std::size_t first = accessors_.size();
        for (const std::size_t vector : {0u, 1u, 2u})
            add_floats("VEC3", begin + vector * vector_bytes, part.vertices.size());
        if (!texcoords_.empty())
            add_floats("VEC2", begin + vectors_bytes, part.vertices.size());
        accessors_[first]["min"] = {low.x, low.y, low.z};
        accessors_[first]["max"] = {high.x, high.y, high.z};
    }

    [[nodiscard]] std::size_t vertex_bytes() const {
        return vectors_bytes + (texcoords_.empty() ? 0 : texcoord_bytes);
    }

    void add_floats(const char* type, std::size_t offset, std::size_t count) {
        accessors_.push_back({{"bufferView", 0},
                              {"byteOffset", offset},
                              {"componentType", float_component},
                              {"count", count},
                              {"type", type}});
    }

    void add_indices(const Part& part) {
        accessors_.push_back({{"bufferView", 1},
                              {"byteOffset", indices_.size()},
                              {"componentType", uint_component},
                              {"count", part.indices.size()},
                              {"type", "SCALAR"}});
        for (const std::uint32_t index : part.indices)
            append_number(indices_, index);
    }

    const Mesh& mesh_;
    const CornerClasses& classes_;
    const VertexLight& light_;
    int up_;
    std::span<const Vec2> texcoords_;
    std::string vertices_, indices_;
    Json accessors_ = Json::array(), nodes_ = Json::array(), meshes_ = Json::array();
};

} // namespace

void write_glb(const std::string& path, const Mesh& mesh, const CornerClasses& classes,
               const VertexLight& light, const Provenance& from, int up,
               std::span<const Vec2> texcoords) {
    Document document(mesh, classes, light, up, texcoords);
    for (const Part& part : parts_of(mesh, classes))
        document.add(part);
    write_glb_container(path, document.json(from),
                        std::array<std::string_view, 2>{document.vertices(), document.indices()});
}

} // namespace hemilux
