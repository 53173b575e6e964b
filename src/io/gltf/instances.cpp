#include "io/gltf/instances.h"

#include "io/files/error.h"
#include "io/gltf/elements.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <numbers>

namespace hemilux::gltf {

/// Does without recursion: a chain of nodes may be long.
std::vector<Instance> instances_of(const Document& document) {
    std::vector<Instance> found, open;
    for (const std::size_t root : document.roots)
        open.push_back({root, glm::dmat4(1.0)});
    std::ranges::reverse(open);
    while (!open.empty()) {
        Instance instance = open.back();
        open.pop_back();
        const Node& node = document.nodes[instance.node];
        if (!node.visible)
            continue;
        instance.to_world = instance.to_world * node.transform;
        found.push_back(instance);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, instance.to_world});
    }
    return found;
}

std::size_t count_placed_meshes(const Document& document, std::size_t node) {
    const std::optional<Node::Instancing>& instancing = document.nodes[node].instancing;
    if (!instancing)
        return 1;
    std::optional<std::size_t> count;
    for (const Index& accessor : {instancing->translation, instancing->rotation, instancing->scale})
        if (accessor)
            count = std::min(count.value_or(document.accessors[*accessor].count),
                             document.accessors[*accessor].count);
    return count.value_or(1);
}

std::vector<Instance> placed_meshes(const Instance& instance, Buffers& buffers) {
    const Document& document = buffers.document();
    const std::optional<Node::Instancing>& instancing = document.nodes[instance.node].instancing;
    if (!instancing)
        return {instance};
    const auto elements = [&](const Index& accessor, const char* type) -> std::optional<Elements> {
        if (!accessor)
            return std::nullopt;
        Elements found(buffers, *accessor);
        found.check(type, {Component::float32, Component::int8, Component::int16});
        return found;
    };
    const auto move = elements(instancing->translation, "VEC3"),
               turn = elements(instancing->rotation, "VEC4"),
               size = elements(instancing->scale, "VEC3");
    const auto vector = [](const Elements& of, std::size_t k) {
        return Vec3(of.at(k, 0), of.at(k, 1), of.at(k, 2));
    };
    std::vector<Instance> placed;
    for (std::size_t k = 0; k < count_placed_meshes(document, instance.node); ++k) {
        glm::dmat4 transform(1.0);
        if (move)
            transform = glm::translate(transform, vector(*move, k));
        if (turn) {
            const glm::dquat rotation(turn->at(k, 3), turn->at(k, 0), turn->at(k, 1),
                                      turn->at(k, 2));
            if (!(glm::length(rotation) > 0))
                turn->fail("element " + std::to_string(k) +
                           ": expected a quaternion of length above 0");
            transform *= glm::mat4_cast(glm::normalize(rotation));
        }
        if (size)
            transform = glm::scale(transform, vector(*size, k));
        placed.push_back({instance.node, instance.to_world * transform, k});
    }
    return placed;
}

std::optional<Camera> camera_of(const Document& document, const Instance& instance) {
    const CameraInfo& camera = document.cameras[*document.nodes[instance.node].camera];
    const Vec3 eye(instance.to_world[3]), back(instance.to_world[2]), up(instance.to_world[1]);
    const double length = glm::length(back);
    if (!camera.vertical_fov || length == 0 || glm::length(up) == 0)
        return {};
    return Camera{.eye = eye,
                  .target = eye - back / length,
                  .up = glm::normalize(up),
                  .vertical_fov_degrees = *camera.vertical_fov * 180 / std::numbers::pi};
}

std::string name_or(const std::string& name, const char* kind, std::size_t number) {
    return name.empty() ? kind + (" " + std::to_string(number)) : name;
}

} // namespace hemilux::gltf
