#pragma once
// The nodes of a scene, each with its place in the world (section 3.5.3), and what it shows there
// besides meshes.

#include "io/gltf/document/document.h"
#include "io/scene_files/camera_of_file.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hemilux::gltf {

struct Instance {
    std::size_t node;
    glm::dmat4 to_world;
};

/// All nodes below the roots of the scene, parents first.
[[nodiscard]] std::vector<Instance> instances_of(const Document& document);

/// The camera of a node that has one, looking along -z of the node, y being up there (section
/// 3.10.3); none where it is not a perspective one or its transform is not finite.
[[nodiscard]] std::optional<Camera> camera_of(const Document& document, const Instance& instance);

/// The name that a part of the file has, else its kind and number.
[[nodiscard]] std::string name_or(const std::string& name, const char* kind, std::size_t number);

} // namespace hemilux::gltf
