#include "io/gltf/lit_file.h"

#include "io/files/error.h"
#include "io/files/little_endian.h"
#include "io/gltf/instances.h"
#include "io/gltf/lit_materials.h"
#include "io/gltf/open_document.h"
#include "io/gltf/scene_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace hemilux {
namespace gltf {
namespace {

constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

class Writer {
  public:
    Writer(LitSource& source, const LightmapOfFile& lightmap)
        : source_(source), lightmap_(lightmap), document_(source), root_(document_.root()),
          meshes_of_file_(root_.value("meshes", Json::array())) {}

    void write(const std::string& path);

  private:
    /// Returns the number of an accessor that an attribute names.
    [[nodiscard]] std::size_t accessor_of(const Json& attribute, const PrimitiveOrigin& of) const;
    void add_coordinates(const AtlasCoordinates& coordinates, std::size_t of_set);
    Json& primitive_of(const PrimitiveOrigin& origin);
    void give_own_mesh(const PrimitiveOrigin& origin);
    void place_instances(const PrimitiveOrigin& origin);
    void forget_instancing();
    std::size_t longer_copy(std::size_t accessor, const std::vector<std::uint32_t>& further);
    std::size_t add_places(const std::vector<glm::vec2>& places);
    std::size_t add_indices(const AtlasCoordinates& coordinates);

    LitSource& source_;
    const LightmapOfFile& lightmap_;
    OpenDocument document_;
    Json& root_; ///< of the document
    const Json meshes_of_file_;
    using Shown = std::pair<std::size_t, std::optional<std::size_t>>; ///< node, number of instance
    std::map<std::size_t, std::size_t> node_of_mesh_;                 ///< that a mesh is kept for
    std::map<Shown, std::size_t> mesh_of_; ///< where it is another one than in the file
    std::map<Shown, std::size_t> node_of_instance_;
};

void Writer::write(const std::string& path) {
    for (const LightmapPicture& picture : lightmap_.pictures) {
        if (lightmap_.pictures.size() > 1)
            for (const std::size_t origin : picture.origins)
                give_own_mesh(source_.origins()[origin]);
        for (const AtlasCoordinates& coordinates : picture.coordinates)
            add_coordinates(coordinates, picture.set);
    }
    forget_instancing();
    LitMaterials materials(
        document_, source_, lightmap_,
        [this](const PrimitiveOrigin& origin) -> Json& { return primitive_of(origin); });
    for (const LightmapPicture& picture : lightmap_.pictures)
        materials.add(picture);
    document_.write(path);
}

std::size_t Writer::accessor_of(const Json& attribute, const PrimitiveOrigin& of) const {
    const std::size_t count = source_.document().accessors.size();
    const std::size_t number = whole_number(attribute).value_or(count);
    const auto vertices = [&] { return source_.document().accessors[number].count; };
    const Index& position = source_.primitive_of(of).position;
    if (number >= count || vertices() < source_.document().accessors[*position].count)
        throw InputError(source_.path(), place_of(of.mesh, of.primitive) +
                                             "/attributes: expected accessors with an element for "
                                             "each vertex");
    return number;
}

/// Returns the primitive that is written for an origin.
Json& Writer::primitive_of(const PrimitiveOrigin& origin) {
    std::size_t mesh = origin.mesh;
    if (const auto found = mesh_of_.find({origin.node, origin.instance}); found != mesh_of_.end())
        mesh = found->second;
    return root_["meshes"][mesh]["primitives"][origin.primitive];
}

/// Gives what shows a mesh one of its own, but for the first node that shows it: their light
/// differs. Instances of a node become nodes below it.
void Writer::give_own_mesh(const PrimitiveOrigin& origin) {
    if (mesh_of_.contains({origin.node, origin.instance}) ||
        (!origin.instance &&
         node_of_mesh_.try_emplace(origin.mesh, origin.node).first->second == origin.node))
        return;
    Json& meshes = root_["meshes"];
    meshes.push_back(meshes_of_file_[origin.mesh]);
    const std::size_t mesh = mesh_of_[{origin.node, origin.instance}] = meshes.size() - 1;
    if (!origin.instance) {
        root_["nodes"][origin.node]["mesh"] = mesh;
        return;
    }
    if (!node_of_instance_.contains({origin.node, origin.instance}))
        place_instances(origin);
    root_["nodes"][node_of_instance_.at({origin.node, origin.instance})]["mesh"] = mesh;
}

/// Makes a node of each instance of a node, also of those that have no area, and show nothing.
void Writer::place_instances(const PrimitiveOrigin& origin) {
    const std::vector<Instance> placed =
        placed_meshes({origin.node, glm::dmat4(1.0)}, source_.buffers());
    Json& nodes = root_["nodes"];
    const std::string name = nodes[origin.node].value("name", "instance");
    for (std::size_t k = 0; k < placed.size(); ++k) {
        Json matrix = Json::array();
        bool is_finite = true; // else JSON has no number for it
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row) {
                matrix.push_back(placed[k].to_world[column][row]);
                is_finite = is_finite && std::isfinite(placed[k].to_world[column][row]);
            }
        if (!is_finite)
            continue;
        node_of_instance_[{origin.node, k}] = nodes.size();
        nodes[origin.node]["children"].push_back(nodes.size());
        nodes.push_back({{"name", name + " " + std::to_string(k)},
                         {"mesh", origin.mesh},
                         {"matrix", std::move(matrix)}});
    }
    Json& parent = nodes[origin.node];
    parent.erase("mesh");
    if (parent.contains("extensions"))
        parent["extensions"].erase(instancing_extension);
    if (parent.value("extensions", Json::object()).empty())
        parent.erase("extensions");
}

/// Takes the extension from the lists where no node uses it any more.
void Writer::forget_instancing() {
    for (const Json& node : document_.array_of("nodes"))
        if (node.value("extensions", Json::object()).contains(instancing_extension))
            return;
    document_.forget_extension(instancing_extension);
}

void Writer::add_coordinates(const AtlasCoordinates& coordinates, std::size_t of_set) {
    const PrimitiveOrigin& origin = source_.origins()[coordinates.origin];
    give_own_mesh(origin);
    if (!coordinates.further.empty()) {
        const Json attributes = primitive_of(origin)["attributes"];
        for (const auto& [name, accessor] : attributes.items())
            primitive_of(origin)["attributes"][name] =
                longer_copy(accessor_of(accessor, origin), coordinates.further);
        if (primitive_of(origin).contains("targets"))
            for (Json& target : primitive_of(origin)["targets"])
                for (Json& accessor : target)
                    accessor = longer_copy(accessor_of(accessor, origin), coordinates.further);
        const std::size_t indices = add_indices(coordinates);
        primitive_of(origin)["indices"] = indices;
        if (primitive_of(origin).contains("mode"))
            primitive_of(origin)["mode"] = triangles_mode;
    }
    const std::size_t places = add_places(coordinates.places);
    Json& attributes = primitive_of(origin)["attributes"];
    // The format has no set without those before it.
    for (std::size_t set = 0; set <= of_set; ++set)
        if (const std::string name = "TEXCOORD_" + std::to_string(set);
            set == of_set || !attributes.contains(name))
            attributes[name] = places;
}

/// Returns a copy of an accessor with further elements behind its own.
std::size_t Writer::longer_copy(std::size_t accessor, const std::vector<std::uint32_t>& further) {
    const Accessor& from = source_.document().accessors[accessor];
    const Elements elements(source_.buffers(), accessor);
    const std::size_t stride = (elements.element_bytes() + 3) / 4 * 4;
    std::string all;
    all.reserve(stride * (from.count + further.size()));
    const auto add = [&](std::size_t element) {
        all += elements.bytes_at(element);
        all.resize((all.size() + stride - 1) / stride * stride, '\0');
    };
    for (std::size_t k = 0; k < from.count; ++k)
        add(k);
    for (const std::uint32_t k : further)
        add(k);
    const std::size_t view = document_.add_view(all);
    Json& of_view = root_["bufferViews"][view];
    of_view["byteStride"] = stride;
    of_view["target"] = vertex_target;
    Json copy = root_["accessors"][accessor];
    copy.erase("sparse");
    copy["bufferView"] = view;
    copy["byteOffset"] = 0;
    copy["count"] = from.count + further.size();
    root_["accessors"].push_back(std::move(copy));
    return root_["accessors"].size() - 1;
}

std::size_t Writer::add_places(const std::vector<glm::vec2>& places) {
    std::string bytes;
    for (const glm::vec2& place : places) {
        append_number(bytes, place.x);
        append_number(bytes, place.y);
    }
    return document_.add_accessor(
        bytes, vertex_target,
        {{"componentType", float_component}, {"count", places.size()}, {"type", "VEC2"}});
}

std::size_t Writer::add_indices(const AtlasCoordinates& coordinates) {
    std::string bytes;
    for (const auto& corners : coordinates.corners)
        for (const std::uint32_t vertex : corners)
            append_number(bytes, vertex);
    return document_.add_accessor(bytes, index_target,
                                  {{"componentType", uint_component},
                                   {"count", 3 * coordinates.corners.size()},
                                   {"type", "SCALAR"}});
}

} // namespace
} // namespace gltf

void write_lit_glb(const std::string& path, gltf::LitSource& source,
                   const LightmapOfFile& lightmap) {
    gltf::Writer(source, lightmap).write(path);
}

} // namespace hemilux
