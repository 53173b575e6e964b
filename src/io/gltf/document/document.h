#pragma once
// The content of a glTF 2.0 file as far as it is geometry, diffuse light and cameras: the arrays of
// its JSON, checked. Indices are within their arrays, accessors within their views, views within
// their buffers; nodes form trees. Section numbers are those of the specification (Khronos 2021).

#include "geometry/vector.h"
#include "io/gltf/document/json_value.h"

#include <glm/mat4x4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hemilux::gltf {

using Index = std::optional<std::size_t>;

struct Buffer {
    std::size_t length = 0;
    std::string uri; ///< empty: the binary chunk
};

struct BufferView {
    std::size_t buffer = 0, offset = 0, length = 0;
    std::size_t stride = 0; ///< 0: elements lie close together
};

enum class Component : std::uint16_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};
[[nodiscard]] std::size_t size_of(Component component);

/// Elements of one type in a view (section 3.6.2).
struct Span {
    std::size_t view = 0, offset = 0;
};
struct Accessor {
    std::optional<Span> span; ///< none: all zeros
    Component component = Component::float32;
    bool normalized = false;
    std::size_t count = 0, components = 1; ///< numbers of elements, and of components per element
    std::string type;                      ///< such as VEC3
    /// Elements that replace others: their indices, ascending, and values.
    struct Sparse {
        std::size_t count = 0;
        Span indices, values;
        Component index_component = Component::uint32;
    };
    std::optional<Sparse> sparse;
};

/// A texture, and the coordinates on which it lies (section 3.9.2 and KHR_texture_transform).
struct TextureInfo {
    std::size_t texture = 0, set = 0;
    Vec2 offset{0.0}, scale{1.0};
    double rotation = 0; ///< [rad]
};

struct MaterialInfo {
    std::string name;
    Vec3 base_colour{1.0}; ///< linear
    Vec3 emissive{0.0};    ///< linear radiance, emissiveStrength included [nt]
    std::optional<TextureInfo> base_texture, emissive_texture;
    double metallic = 1;
    double uncovered = 0;    ///< what alpha leaves open [-] (BLEND without a texture)
    double transmission = 0; ///< of what is covered [-] (KHR_materials_transmission)
    std::optional<TextureInfo> transmission_texture; ///< a factor of it, in red
    bool is_cut_out = false;    ///< lets light through by the alpha of a texture, which is not read
    bool has_occlusion = false; ///< by an occlusionTexture, which means nothing to the light
    bool double_sided = false;
    /// KHR_materials_unlit: the base colour is what it shows, whatever light arrives. Such a
    /// material has it as `emissive`, with its texture, and reflects nothing.
    bool unlit = false;
};

enum class Mode : std::uint8_t { points, lines, loop, line_strip, triangles, strip, fan };
struct Primitive {
    Index position;
    Index indices, material;
    Mode mode = Mode::triangles;
    std::vector<Index> texcoords; ///< accessors by set
    Index normals;                ///< NORMAL
    Index colours;                ///< COLOR_0
    bool has_targets = false;
};
struct MeshInfo {
    std::string name;
    std::vector<Primitive> primitives;
};

struct Node {
    std::string name;
    glm::dmat4 transform{1.0}; ///< transform to the parent
    std::vector<std::size_t> children;
    Index mesh, camera, light;
    bool has_skin = false;
    bool visible = true; ///< else it and all below are hidden (KHR_node_visibility)
    /// The accessors of EXT_mesh_gpu_instancing: the mesh is shown once for each of their elements,
    /// placed by it before the node's own transform.
    struct Instancing {
        Index translation, rotation, scale;
    };
    std::optional<Instancing> instancing;
};

/// A light of KHR_lights_punctual, in photometric units.
struct Light {
    enum class Kind : std::uint8_t { point, spot, directional };
    Kind kind = Kind::point;
    Vec3 colour{1.0};
    double intensity = 1;                                   ///< [cd]; directional [lx]
    double inner_cone = 0, outer_cone = 0.7853981633974483; ///< [rad], from the axis
};

struct CameraInfo {
    std::string name;
    std::optional<double> vertical_fov; ///< [rad]; none: orthographic
};

/// A picture, as bytes in a view or by its URI.
struct ImageInfo {
    Index view;
    std::string uri, media_type;
};
/// The wrapping of a texture: 10497, 33071 and 33648 in the file.
enum class Wrapping : std::uint8_t { repeat, clamp, mirror };
struct TextureSource {
    Index image;                   ///< none: of a kind that is not read, or missing
    Index webp;                    ///< the same as WebP (EXT_texture_webp)
    bool is_of_other_kind = false; ///< the file has it as WebP, KTX2 or AVIF
    Wrapping wrap_s = Wrapping::repeat, wrap_t = Wrapping::repeat;
};

struct Document {
    std::vector<Buffer> buffers;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<MaterialInfo> materials;
    std::vector<MeshInfo> meshes;
    std::vector<Node> nodes;
    std::vector<std::size_t> roots; ///< roots of the scene that is shown
    std::vector<Light> lights;
    std::vector<CameraInfo> cameras;
    std::vector<std::string>
        unread_extensions; ///< that the file uses and that may change what it shows
    /// Images and textures that no material in use refers to may be wrong: they are not looked at.
    std::vector<ImageInfo> images;
    std::vector<TextureSource> textures;
};

/// Throws InputError.
[[nodiscard]] Document read_document(const JsonValue& root);

/// Each of these reads a part of the document that has a source file of its own.
void read_buffers(const JsonValue& root, Document& document);
void read_materials(const JsonValue& root, Document& document);
void read_nodes(const JsonValue& root, Document& document);

} // namespace hemilux::gltf
