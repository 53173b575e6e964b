#include "io/gltf/lit_file.h"

#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/files/little_endian.h"
#include "io/gltf/instances.h"
#include "io/gltf/scene_meshes.h"
#include "io/meshes/glb_container.h"
#include "radiosity/paper/scene/scene.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace hemilux {
namespace gltf {
namespace {

using Json = nlohmann::ordered_json;

constexpr int vertex_target = 34962, index_target = 34963; // names of OpenGL's constants
constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";
constexpr const char* variants_extension = "KHR_materials_variants";
constexpr const char* unlit_extension = "KHR_materials_unlit";
constexpr const char* lightmap_extension = "MOZ_lightmap";
constexpr int float_component = 5126, uint_component = 5125;
constexpr int linear_filter = 9729, clamp_to_edge = 33071, triangles_mode = 4;

/// Returns a whole number, which may be written as 2.0; nothing for any other value.
std::optional<std::size_t> whole_number(const Json& value) {
    constexpr double limit = 1LL << 53; // doubles hold all up to it
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= limit && std::floor(number) == number))
        return std::nullopt;
    return static_cast<std::size_t>(number);
}

std::optional<std::size_t> whole_of(const Json& object, const char* key) {
    return object.is_object() && object.contains(key) ? whole_number(object[key]) : std::nullopt;
}

/// Returns a material that says what is solved for a primitive without one.
Json default_material() {
    const Vec3 grey = Material().reflectance;
    return {{"name", "default"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {grey.r, grey.g, grey.b, 1}},
              {"metallicFactor", 0},
              {"roughnessFactor", 1}}}};
}

class Writer {
  public:
    Writer(LitSource& source, const LightmapOfFile& lightmap)
        : source_(source), lightmap_(lightmap), root_(Json::parse(source.container().json)),
          meshes_of_file_(root_.value("meshes", Json::array())),
          materials_of_file_(root_.value("materials", Json::array())) {
        // Members lie in one array: with room for all that are added, references to them stay
        // valid.
        constexpr std::size_t most_added = 16;
        root_.get_ref<Json::object_t&>().reserve(root_.size() + most_added);
    }

    /// Makes the JSON and the binary chunk.
    void make() {
        join_buffers();
        embed_pictures();
        for (const LightmapPicture& picture : lightmap_.pictures) {
            if (lightmap_.pictures.size() > 1)
                for (const std::size_t origin : picture.origins)
                    give_own_mesh(source_.origins()[origin]);
            for (const AtlasCoordinates& coordinates : picture.coordinates)
                add_coordinates(coordinates, picture.set);
        }
        forget_instancing();
        for (const LightmapPicture& picture : lightmap_.pictures) {
            const std::optional<std::size_t> shown = add_shown(picture);
            const std::size_t texture = add_texture(picture);
            if (lightmap_.binding != Binding::texture)
                bind_primitives(texture, shown, picture);
        }
        root_["buffers"][0]["byteLength"] = binary_.size();
    }
    void write(const std::string& path) const;

  private:
    /// Returns an array of the document, which is made where there is none.
    Json& array_of(const char* name) { return array_in(root_, name, ""); }
    /// Returns an array of an object that stands at `place`.
    Json& array_in(Json& object, const char* name, const std::string& place) const;
    /// Returns an extension of an object, which is made where there is none.
    Json& extension_of(Json& object, const char* name, const std::string& place) const;
    void use_extension(const char* name);
    /// Returns the number of an accessor that an attribute names.
    [[nodiscard]] std::size_t accessor_of(const Json& attribute, const PrimitiveOrigin& of) const;
    void join_buffers();
    void embed_pictures();
    std::size_t add_view(std::string_view bytes);
    std::size_t add_texture(const std::string& name, std::string_view png, Json extras);
    std::size_t add_texture(const LightmapPicture& picture);
    std::optional<std::size_t> add_shown(const LightmapPicture& picture);
    void bind_primitives(std::size_t texture, std::optional<std::size_t> shown,
                         const LightmapPicture& picture);
    void bind(Json& material, std::size_t texture, const LightmapPicture& picture) const;
    [[nodiscard]] bool is_unlit(const Json& primitive) const;
    [[nodiscard]] std::size_t own_material(const Json& primitive, const LightmapPicture& picture);
    [[nodiscard]] std::size_t lit_material(std::size_t own, std::size_t shown,
                                           const LightmapPicture& picture);
    void add_variants(Json& primitive, std::size_t lit, std::size_t own, const std::string& place);
    void add_coordinates(const AtlasCoordinates& coordinates, std::size_t of_set);
    Json& primitive_of(const PrimitiveOrigin& origin);
    void give_own_mesh(const PrimitiveOrigin& origin);
    void place_instances(const PrimitiveOrigin& origin);
    void forget_instancing();
    std::size_t longer_copy(std::size_t accessor, const std::vector<std::uint32_t>& further);
    std::size_t add_accessor(std::string_view bytes, int target, const Json& elements);
    std::size_t add_places(const std::vector<glm::vec2>& places);
    std::size_t add_indices(const AtlasCoordinates& coordinates);
    void pad() { binary_.resize((binary_.size() + 3) / 4 * 4, '\0'); }

    LitSource& source_;
    const LightmapOfFile& lightmap_;
    Json root_;
    const Json meshes_of_file_, materials_of_file_;
    std::string binary_;
    using Shown = std::pair<std::size_t, std::optional<std::size_t>>; ///< node, number of instance
    std::map<std::size_t, std::size_t> node_of_mesh_;                 ///< that a mesh is kept for
    std::map<Shown, std::size_t> mesh_of_; ///< where it is another one than in the file
    std::map<Shown, std::size_t> node_of_instance_;
    std::map<std::size_t, const LightmapPicture*> picture_of_material_; ///< that it is kept for
    using Lit =
        std::pair<std::optional<std::size_t>, const LightmapPicture*>; ///< none: the default
    std::set<const Json*> bound_;               ///< primitives that have their materials
    std::map<Lit, std::size_t> material_of_;    ///< where it is another one than in the file
    std::map<std::size_t, std::size_t> lit_of_; ///< material that shows another one lit
    std::optional<std::size_t> first_variant_;  ///< its number: lit; the next one is as in the file
    std::optional<std::size_t> sampler_;
};

Json& Writer::array_in(Json& object, const char* name, const std::string& place) const {
    Json& member = object[name];
    if (member.is_null())
        member = Json::array();
    if (!member.is_array())
        throw InputError(source_.path(), place + "/" + name + ": expected an array");
    return member;
}

Json& Writer::extension_of(Json& object, const char* name, const std::string& place) const {
    Json* member = &object;
    std::string path = place;
    for (const char* const key : {"extensions", name}) {
        member = &(*member)[key];
        path += std::string("/") + key;
        if (member->is_null())
            *member = Json::object();
        if (!member->is_object())
            throw InputError(source_.path(), path + ": expected an object");
    }
    return *member;
}

void Writer::use_extension(const char* name) {
    Json& used = array_of("extensionsUsed");
    if (std::ranges::find(used, name) == used.end())
        used.push_back(name);
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

/// The buffers follow each other in one.
void Writer::join_buffers() {
    const Document& document = source_.document();
    std::vector<std::size_t> begin;
    for (std::size_t b = 0; b < document.buffers.size(); ++b) {
        begin.push_back(binary_.size());
        binary_ += source_.buffers().content(b);
        pad();
    }
    Json& buffers = array_of("buffers");
    if (buffers.empty())
        buffers.push_back(Json::object());
    const auto move = [&](Json& view) {
        const std::size_t b = whole_of(view, "buffer").value_or(0);
        if (b == 0 || b >= begin.size())
            return;
        view["byteOffset"] = whole_of(view, "byteOffset").value_or(0) + begin[b];
        view["buffer"] = 0;
    };
    for (Json& view : array_of("bufferViews")) {
        move(view);
        if (view.contains("extensions") && view["extensions"].is_object())
            for (Json& extension : view["extensions"]) // as of compressed views
                if (extension.is_object())
                    move(extension);
    }
    buffers.erase(buffers.begin() + 1, buffers.end());
    buffers[0].erase("uri");
}

/// Pictures beside the file would be lost where the new file lies elsewhere.
void Writer::embed_pictures() {
    for (std::size_t i = 0; i < source_.pictures().size(); ++i) {
        const std::string& name = source_.pictures()[i];
        if (name.empty())
            continue;
        Json& image = root_["images"][i];
        const std::string bytes = read_input(name, InputKind::regular, {});
        image["bufferView"] = add_view(bytes);
        if (!image.contains("mimeType"))
            image["mimeType"] = bytes.starts_with("\x89PNG") ? "image/png"
                                : name.ends_with(".webp")    ? "image/webp"
                                : name.ends_with(".ktx2")    ? "image/ktx2"
                                                             : "image/jpeg";
        if (!image.contains("name"))
            image["name"] = std::filesystem::path(name).stem().string();
        image.erase("uri");
    }
}

std::size_t Writer::add_view(std::string_view bytes) {
    Json& views = array_of("bufferViews");
    views.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
    binary_ += bytes;
    pad();
    return views.size() - 1;
}

std::size_t Writer::add_texture(const std::string& name, std::string_view png, Json extras) {
    const std::size_t view = add_view(png);
    Json& images = array_of("images");
    images.push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    if (!sampler_) {
        Json& samplers = array_of("samplers");
        sampler_ = samplers.size();
        samplers.push_back({{"magFilter", linear_filter},
                            {"minFilter", linear_filter},
                            {"wrapS", clamp_to_edge},
                            {"wrapT", clamp_to_edge}});
    }
    Json& textures = array_of("textures");
    extras["exposure"] = lightmap_.exposure;
    if (!lightmap_.command.empty())
        extras["command"] = lightmap_.command;
    textures.push_back({{"name", name},
                        {"sampler", *sampler_},
                        {"source", images.size() - 1},
                        {"extras", {{"hemilux", std::move(extras)}}}});
    return textures.size() - 1;
}

std::size_t Writer::add_texture(const LightmapPicture& picture) {
    return add_texture(
        picture.name, picture.png,
        {{"bake", lightmap_.bake}, {"texCoord", picture.set}, {"intensity", picture.intensity}});
}

std::optional<std::size_t> Writer::add_shown(const LightmapPicture& picture) {
    if (lightmap_.binding != Binding::lit)
        return std::nullopt;
    return add_texture(picture.name + " times colours", picture.shown,
                       {{"bake", "shown"}, {"texCoord", picture.set}});
}

/// Returns the material of a primitive whose light is in this picture. It is that of the file for
/// the first picture that needs it, and a copy for each other one. A primitive without a material
/// gets what was solved in its place: the format's default is a metal.
std::size_t Writer::own_material(const Json& primitive, const LightmapPicture& picture) {
    std::optional<std::size_t> of_file;
    if (primitive.contains("material"))
        of_file = primitive["material"].get<std::size_t>();
    if (of_file && picture_of_material_.try_emplace(*of_file, &picture).first->second == &picture)
        return *of_file;
    Json& materials = array_of("materials");
    const auto [found, is_new] = material_of_.try_emplace({of_file, &picture}, materials.size());
    if (is_new)
        materials.push_back(of_file ? materials_of_file_[*of_file] : default_material());
    return found->second;
}

/// Returns the material that shows another one as it is lit. It has the other's alpha and sides.
std::size_t Writer::lit_material(std::size_t own, std::size_t shown,
                                 const LightmapPicture& picture) {
    Json& materials = array_of("materials");
    const auto [found, is_new] = lit_of_.try_emplace(own, materials.size());
    if (!is_new)
        return found->second;
    const Json& of_file = materials[own];
    const Json surface = of_file.value("pbrMetallicRoughness", Json::object());
    Json factor = {1, 1, 1, 1};
    if (surface.contains("baseColorFactor"))
        factor[3] = surface["baseColorFactor"].at(3);
    Json lit{{"name", of_file.value("name", "material") + " lit"},
             {"pbrMetallicRoughness",
              {{"baseColorTexture", {{"index", shown}, {"texCoord", picture.set}}},
               {"baseColorFactor", std::move(factor)},
               {"metallicFactor", 0},
               {"roughnessFactor", 1}}},
             {"extensions", {{unlit_extension, Json::object()}}}};
    for (const char* const kept : {"alphaMode", "alphaCutoff", "doubleSided"})
        if (of_file.contains(kept))
            lit[kept] = of_file[kept];
    materials.push_back(std::move(lit));
    return found->second;
}

/// Lets a primitive have two materials, the first of which is shown unless another is chosen.
void Writer::add_variants(Json& primitive, std::size_t lit, std::size_t own,
                          const std::string& place) {
    Json& variants = array_in(extension_of(root_, variants_extension, ""), "variants",
                              std::string("/extensions/") + variants_extension);
    if (!first_variant_) {
        first_variant_ = variants.size();
        variants.push_back({{"name", "lit"}});
        variants.push_back({{"name", "lightmap"}});
    }
    Json& mappings = array_in(extension_of(primitive, variants_extension, place), "mappings",
                              place + "/extensions/" + variants_extension);
    mappings.push_back({{"material", lit}, {"variants", {*first_variant_}}});
    mappings.push_back({{"material", own}, {"variants", {*first_variant_ + 1}}});
}

/// Returns whether viewers show a primitive as it is, whatever light arrives.
bool Writer::is_unlit(const Json& primitive) const {
    if (!primitive.contains("material"))
        return false;
    const auto material = primitive["material"].get<std::size_t>();
    return source_.document().materials[material].unlit;
}

void Writer::bind(Json& material, std::size_t texture, const LightmapPicture& picture) const {
    const Json info{{"index", texture}, {"texCoord", picture.set}};
    switch (lightmap_.binding) {
    case Binding::unlit: {
        Json& surface = material["pbrMetallicRoughness"];
        surface["baseColorTexture"] = info;
        surface["baseColorFactor"] = {1, 1, 1, 1};
        for (const char* const lit : {"emissiveFactor", "emissiveTexture", "normalTexture",
                                      "occlusionTexture", "extensions"})
            material.erase(lit);
        material["extensions"][unlit_extension] = Json::object();
        return;
    }
    case Binding::occlusion:
        material["occlusionTexture"] = info;
        return;
    case Binding::lit:
    case Binding::lightmap: {
        Json& extension = material["extensions"][lightmap_extension];
        extension = info;
        extension["intensity"] = picture.intensity;
        return;
    }
    case Binding::texture:
        return;
    }
}

/// Binds the texture to the materials of the picture's primitives. What viewers show as it is stays
/// so where others are shown as they are lit.
void Writer::bind_primitives(std::size_t texture, std::optional<std::size_t> shown,
                             const LightmapPicture& picture) {
    std::set<std::size_t> used;
    bool any_lit = false;
    for (const std::size_t number : picture.origins) {
        const PrimitiveOrigin& origin = source_.origins()[number];
        Json& primitive = primitive_of(origin);
        if (!primitive["attributes"].contains("TEXCOORD_" + std::to_string(picture.set)))
            continue;
        // Nodes that share a mesh share its primitive, which has its new material already.
        if (!bound_.insert(&primitive).second || (shown && is_unlit(primitive)))
            continue;
        const std::size_t own = own_material(primitive, picture);
        primitive["material"] = own;
        used.insert(own);
        if (!shown)
            continue;
        primitive["material"] = lit_material(own, *shown, picture);
        add_variants(primitive, primitive["material"], own,
                     place_of(origin.mesh, origin.primitive));
        any_lit = true;
    }
    for (const std::size_t m : used)
        bind(root_["materials"][m], texture, picture);
    if (used.empty() || lightmap_.binding == Binding::occlusion)
        return;
    if (any_lit)
        use_extension(variants_extension);
    if (any_lit || lightmap_.binding == Binding::unlit)
        use_extension(unlit_extension);
    if (lightmap_.binding != Binding::unlit)
        use_extension(lightmap_extension);
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
    for (const Json& node : array_of("nodes"))
        if (node.value("extensions", Json::object()).contains(instancing_extension))
            return;
    for (const char* const list : {"extensionsUsed", "extensionsRequired"})
        if (root_.contains(list)) {
            Json& names = array_of(list);
            names.erase(std::remove(names.begin(), names.end(), instancing_extension), names.end());
            if (names.empty())
                root_.erase(list);
        }
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
    const std::size_t view = add_view(all);
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

/// Adds an accessor of all these bytes, for a target of OpenGL's.
std::size_t Writer::add_accessor(std::string_view bytes, int target, const Json& elements) {
    const std::size_t view = add_view(bytes);
    root_["bufferViews"][view]["target"] = target;
    Json accessor{{"bufferView", view}};
    accessor.update(elements);
    Json& accessors = array_of("accessors");
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
}

std::size_t Writer::add_places(const std::vector<glm::vec2>& places) {
    std::string bytes;
    for (const glm::vec2& place : places) {
        append_number(bytes, place.x);
        append_number(bytes, place.y);
    }
    return add_accessor(
        bytes, vertex_target,
        {{"componentType", float_component}, {"count", places.size()}, {"type", "VEC2"}});
}

std::size_t Writer::add_indices(const AtlasCoordinates& coordinates) {
    std::string bytes;
    for (const auto& corners : coordinates.corners)
        for (const std::uint32_t vertex : corners)
            append_number(bytes, vertex);
    return add_accessor(bytes, index_target,
                        {{"componentType", uint_component},
                         {"count", 3 * coordinates.corners.size()},
                         {"type", "SCALAR"}});
}

void Writer::write(const std::string& path) const {
    // A name that is not UTF-8 must not cost the user the file.
    write_glb_container(path, root_.dump(-1, ' ', false, Json::error_handler_t::replace),
                        std::array<std::string_view, 1>{binary_});
}

} // namespace
} // namespace gltf

void write_lit_glb(const std::string& path, gltf::LitSource& source,
                   const LightmapOfFile& lightmap) {
    gltf::Writer writer(source, lightmap);
    writer.make();
    writer.write(path);
}

} // namespace hemilux
