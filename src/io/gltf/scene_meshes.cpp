#include "io/gltf/scene_meshes.h"

#include "io/files/error.h"
#include "io/files/text_words.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hemilux::gltf {

std::string place_of(std::size_t mesh, std::size_t primitive) {
    return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(primitive);
}

std::uint32_t SceneMeshes::group_of(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(result_.scene.groups.size());
    const auto [found, is_new] = group_index_.try_emplace(name, next);
    if (is_new)
        result_.scene.groups.push_back(name);
    return found->second;
}

/// Returns the material of primitives without one, the same as of an OBJ file that names none.
std::uint32_t SceneMeshes::default_material() {
    if (!default_material_) {
        default_material_ = static_cast<std::uint32_t>(result_.scene.materials.size());
        result_.scene.materials.emplace_back().name = "default";
        result_.material_source.emplace_back();
    }
    return *default_material_;
}

const Triangles& SceneMeshes::triangles_of(std::size_t mesh, std::size_t number) {
    const std::vector<Primitive>& primitives = document_.meshes[mesh].primitives;
    std::vector<std::optional<Triangles>>& of_mesh = read_[mesh];
    of_mesh.resize(primitives.size());
    if (!of_mesh[number])
        of_mesh[number] =
            triangles_.read(primitives[number], place_of(mesh, number),
                            std::min(maps_.sets(), primitives[number].texcoords.size()),
                            is_unlit(primitives[number]));
    return *of_mesh[number];
}

/// Returns whether the colours of a primitive are light, those of its vertices too.
bool SceneMeshes::is_unlit(const Primitive& primitive) const {
    return primitive.material && document_.materials[*primitive.material].unlit;
}

void SceneMeshes::add(const Instance& instance) {
    const Node& node = document_.nodes[instance.node];
    const MeshInfo& mesh = document_.meshes[*node.mesh];
    const std::uint32_t group =
        group_of(!node.name.empty() ? node.name : name_or(mesh.name, "node", instance.node));
    tally_.skins += node.has_skin;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
        add_primitive(instance, *node.mesh, p, group);
}

void SceneMeshes::add_primitive(const Instance& instance, std::size_t mesh, std::size_t number,
                                std::uint32_t group) {
    const Primitive& primitive = document_.meshes[mesh].primitives[number];
    tally_.lines += primitive.mode < Mode::triangles;
    tally_.coloured += primitive.colours && !is_unlit(primitive);
    tally_.morphed += primitive.has_targets;
    if (!primitive.position || primitive.mode < Mode::triangles)
        return;
    const Triangles& triangles = triangles_of(mesh, number);
    const std::uint32_t material =
        primitive.material ? static_cast<std::uint32_t>(*primitive.material) : default_material();
    tally_.without_coordinates += textures_of(result_.scene).has_texture(material) &&
                                  primitive.texcoords.size() < maps_.sets();
    Scene& scene = result_.scene;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    place(triangles.points, instance);
    result_.origins.push_back({instance.node, mesh, number, scene.faces,
                               static_cast<std::uint32_t>(triangles.corners.size()), first,
                               static_cast<std::uint32_t>(triangles.points.size()),
                               instance.number});
    const bool mirrored = glm::determinant(glm::dmat3(instance.to_world)) < 0;
    for (auto [a, b, c] : triangles.corners) {
        if (mirrored)
            std::swap(b, c);
        const std::uint32_t face = scene.faces++;
        if (division_.divide(std::array{world_[a], world_[b], world_[c]}).degenerate) {
            ++result_.degenerate_faces;
            continue;
        }
        scene.facets.push_back(
            {{first + a, first + b, first + c, first + c}, face, material, group});
        add_texcoords(primitive, triangles, {a, b, c});
        if (!triangles.colours.empty())
            add_tints(triangles, {a, b, c});
    }
    scene.vertices.insert(scene.vertices.end(), world_.begin(), world_.end());
}

void SceneMeshes::add_texcoords(const Primitive& primitive, const Triangles& triangles,
                                const std::array<std::uint32_t, 3>& corners) {
    for (std::size_t set = 0; set < maps_.sets(); ++set) {
        Texcoords& to = own_textures_of(result_.scene).texcoords[set].emplace_back();
        to.fill(glm::vec2(0.0f));
        if (set < std::min(triangles.texcoords.size(), primitive.texcoords.size()))
            for (std::size_t k = 0; k < 4; ++k)
                to[k] = triangles.texcoords[set][corners[std::min<std::size_t>(k, 2)]];
    }
}

/// Adds the colours of corners to the facet that was added last, whose material is unlit.
void SceneMeshes::add_tints(const Triangles& triangles,
                            const std::array<std::uint32_t, 3>& corners) {
    SceneTextures& textures = own_textures_of(result_.scene);
    const std::uint32_t material = result_.scene.facets.back().material;
    textures.of_material.resize(document_.materials.size());
    MaterialTextures& of_material = textures.of_material[material];
    if (!of_material.emission.texture) // else it has the factor already
        of_material.emission.factor = result_.scene.materials[material].emission;
    of_material.tinted = true;
    constexpr Tints none{glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f), glm::vec3(1.0f)};
    textures.tints.resize(result_.scene.facets.size(), none);
    for (std::size_t k = 0; k < 4; ++k)
        textures.tints.back()[k] = triangles.colours[corners[std::min<std::size_t>(k, 2)]];
}

/// Finds the places of a primitive's points in the world.
void SceneMeshes::place(const std::vector<Vec3>& points, const Instance& instance) {
    world_.clear();
    for (const Vec3& point : points) {
        const Vec3 world(instance.to_world * glm::dvec4(point, 1.0));
        if (!(std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) <=
              largest_number))
            throw InputError(path_,
                             "/nodes/" + std::to_string(instance.node) +
                                 ": expected a transform that leaves all places within 1e100");
        world_.push_back(world);
    }
}

} // namespace hemilux::gltf
