#pragma once
// The nodes of a scene, each with its place in the world (section 3.5.3), and what it shows there
// besides meshes.

#include "io/gltf/document/document.h"
#include "radiosity/answers/views/camera.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hemilux::gltf {

struct Instance {
    std::size_t node;
    glm::dmat4 to_world;
    std::optional<std::size_t> number = {}; ///< by EXT_mesh_gpu_instancing
};

/// Returns the roots of the scene and all nodes below them, parents first, without hidden ones.
[[nodiscard]] std::vector<Instance> instances_of(const Document& document);

class Buffers;
/// Returns the places at which a node shows its mesh: several with EXT_mesh_gpu_instancing. Throws
/// InputError.
[[nodiscard]] std::vector<Instance> placed_meshes(const Instance& instance, Buffers& buffers);
/// Returns how many these are.
[[nodiscard]] std::size_t count_placed_meshes(const Document& document, std::size_t node);

/// Returns the camera of a node that has one, which looks along -z of the node, with y up (section
/// 3.10.3). It returns none where the camera is not a perspective one or has no direction. The
/// transform may not be finite, and then the camera is neither.
[[nodiscard]] std::optional<Camera> camera_of(const Document& document, const Instance& instance);

/// Returns the name that a part of the file has, else its kind and number.
[[nodiscard]] std::string name_or(const std::string& name, const char* kind, std::size_t number);

} // namespace hemilux::gltf
