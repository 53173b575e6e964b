// Nodes and which of them the scene shows (sections 3.5.1 and 3.5.2).

#include "io/gltf/document/document.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace hemilux::gltf {
namespace {

/// Reads the transform of a node: a matrix, or translation after rotation after scale.
glm::dmat4 read_transform(const JsonValue& value) {
    if (const auto matrix = value.find("matrix")) {
        std::array<double, 16> columns{};
        matrix->numbers(columns);
        return glm::make_mat4(columns.data());
    }
    std::array<double, 3> move{0, 0, 0}, scale{1, 1, 1};
    std::array<double, 4> turn{0, 0, 0, 1}; // x, y, z, w
    value.numbers_of("translation", move);
    value.numbers_of("rotation", turn);
    value.numbers_of("scale", scale);
    const glm::dquat rotation(turn[3], turn[0], turn[1], turn[2]);
    if (!(glm::length(rotation) > 0))
        value.at("rotation").fail("expected a quaternion of length 1, found 0");
    return glm::translate(glm::dmat4(1.0), Vec3(move[0], move[1], move[2])) *
           glm::mat4_cast(glm::normalize(rotation)) *
           glm::scale(glm::dmat4(1.0), Vec3(scale[0], scale[1], scale[2]));
}

Node read_node(const JsonValue& value, std::size_t nodes, const Document& document) {
    Node node;
    node.name = value.text_or("name", "");
    node.transform = read_transform(value);
    for (const JsonValue& child : value.elements_of("children"))
        node.children.push_back(child.index(nodes, "nodes"));
    node.mesh = value.index_in("mesh", document.meshes.size(), "meshes");
    node.camera = value.index_in("camera", document.cameras.size(), "cameras");
    node.has_skin = value.find("skin").has_value();
    if (const auto light = value.extension("KHR_lights_punctual"))
        node.light = light->at("light").index(document.lights.size(), "lights");
    if (const auto visibility = value.extension("KHR_node_visibility"))
        node.visible = visibility->flag_or("visible", true);
    if (const auto instancing = value.extension("EXT_mesh_gpu_instancing")) {
        const JsonValue attributes = instancing->at("attributes");
        const auto accessor = [&](const char* name) {
            return attributes.index_in(name, document.accessors.size(), "accessors");
        };
        node.instancing = {accessor("TRANSLATION"), accessor("ROTATION"), accessor("SCALE")};
    }
    return node;
}

/// Checks that each node has one parent at most and that none is its own ancestor. Returns those
/// without parents.
std::vector<std::size_t> check_trees(const std::vector<JsonValue>& values,
                                     const std::vector<Node>& nodes) {
    std::vector<bool> has_parent(nodes.size()), reached(nodes.size());
    for (std::size_t n = 0; n < nodes.size(); ++n)
        for (const std::size_t child : nodes[n].children) {
            if (has_parent[child])
                values[n]
                    .at("children")
                    .fail("expected nodes without other parents; node " + std::to_string(child) +
                          " has one already");
            has_parent[child] = true;
        }
    std::vector<std::size_t> roots, open;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        if (!has_parent[n])
            roots.push_back(n);
    for (open = roots; !open.empty();) {
        const std::size_t n = open.back();
        open.pop_back();
        reached[n] = true;
        open.insert(open.end(), nodes[n].children.begin(), nodes[n].children.end());
    }
    if (const auto in_cycle = std::ranges::find(reached, false); in_cycle != reached.end())
        values[static_cast<std::size_t>(in_cycle - reached.begin())].fail(
            "expected a tree of nodes; this node is its own ancestor");
    return roots;
}

/// Returns the roots of the scene that the file shows first; all where the file has no scenes.
std::vector<std::size_t> roots_of_scene(const JsonValue& root, std::size_t nodes,
                                        std::vector<std::size_t> all) {
    const std::vector<JsonValue> scenes = root.elements_of("scenes");
    const Index shown = root.index_in("scene", scenes.size(), "scenes");
    if (scenes.empty())
        return all;
    std::vector<std::size_t> roots;
    for (const JsonValue& value : scenes[shown.value_or(0)].elements_of("nodes")) {
        roots.push_back(value.index(nodes, "nodes"));
        if (!std::ranges::binary_search(all, roots.back()))
            value.fail("expected a node without a parent, found " + std::to_string(roots.back()));
    }
    std::vector<std::size_t> sorted = roots;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end())
        scenes[shown.value_or(0)].at("nodes").fail("expected each node once");
    return roots;
}

} // namespace

void read_nodes(const JsonValue& root, Document& document) {
    const std::vector<JsonValue> values = root.elements_of("nodes");
    for (const JsonValue& value : values)
        document.nodes.push_back(read_node(value, values.size(), document));
    document.roots = roots_of_scene(root, values.size(), check_trees(values, document.nodes));
}

} // namespace hemilux::gltf
