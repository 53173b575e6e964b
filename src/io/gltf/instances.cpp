#include "io/gltf/instances.h"

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
        instance.to_world = instance.to_world * node.transform;
        found.push_back(instance);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, instance.to_world});
    }
    return found;
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
