#include "io/gltf/gltf.h"

#include "io/files/error.h"
#include "io/files/text_words.h"
#include "io/gltf/lights.h"
#include "io/gltf/scene_meshes.h"
#include "io/scene_files/glass.h"
#include "radiosity/answers/asked/text.h"
#include "radiosity/light/lamps/emitter_shapes.h"
#include "radiosity/light/sides/shells.h"
#include "radiosity/light/textures/scene_textures.h"
#include "radiosity/light/textures/textured_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace gltf {
namespace {

/// A few nodes may show one mesh very often; no more patches than these can be solved anyway.
constexpr std::size_t max_triangles = 50'000'000;
/// Memory that a triangle takes with its corners, while it is read.
constexpr double bytes_per_triangle = 200;
/// A material is called a metal from here on.
constexpr double metal = 0.5;

class Reader {
  public:
    Reader(const std::string& path, const ReadGuard& guard, bool textures, Outside outside)
        : path_(path), guard_(guard), textures_(textures), container_(read_container(path, guard)),
          json_(container_.json, path), document_(read_document(json_.root())),
          outside_(path, outside, result_.warnings),
          buffers_(document_, container_, path_, guard_, outside_), maps_(buffers_, guard_),
          instances_(instances_of(document_)) {}

    ReadResult read();

  private:
    void count_triangles_of_scene();
    void add_materials();
    void mark_two_sided();
    void add_camera(const Instance& instance);
    void add_lights();
    [[nodiscard]] Vec3 transmittance_of(std::size_t material);
    void find_glass();
    void collect_warnings(const MeshTally& meshes);
    void warn_of_unlit();
    void warn(std::size_t count, const std::string& one, const std::string& many);
    [[noreturn]] void fail(const std::string& place, const std::string& message) const {
        throw InputError(path_, place + ": " + message);
    }

    std::string path_;
    const ReadGuard& guard_;
    bool textures_;
    ReadResult result_;
    Container container_;
    JsonDocument json_;
    Document document_;
    OutsideFiles outside_;
    Buffers buffers_;
    TextureMaps maps_;
    std::vector<Instance> instances_;
    std::vector<bool> used_;       ///< materials
    std::size_t orthographic_ = 0; ///< cameras before the one that is taken
};

ReadResult Reader::read() {
    if (!container_.warning.empty())
        result_.warnings.push_back(path_ + ": " + container_.warning);
    count_triangles_of_scene();
    add_materials();
    own_textures_of(result_.scene).texcoords.resize(maps_.sets());
    SceneMeshes meshes(buffers_, maps_, result_);
    for (const Instance& instance : instances_) {
        const Node& node = document_.nodes[instance.node];
        if (node.mesh)
            for (const Instance& placed : placed_meshes(instance, buffers_))
                meshes.add(placed);
        if (node.camera)
            add_camera(instance);
    }
    if (result_.scene.facets.empty())
        throw InputError(path_, result_.scene.faces > 0
                                    ? "none of the triangles has an area"
                                    : "no triangles; expected a scene whose nodes show meshes");
    mark_two_sided();
    set_tinted_means(result_.scene);
    add_lights();
    SceneTextures& textures = own_textures_of(result_.scene);
    for (std::vector<Texcoords>& set : textures.texcoords)
        set.resize(result_.scene.facets.size());
    if (!textures.tints.empty()) {
        Tints none;
        none.fill(glm::vec3(1.0f));
        textures.tints.resize(result_.scene.facets.size(), none);
    }
    collect_warnings(meshes.tally());
    result_.textures = maps_.paths();
    result_.libraries = buffers_.files();
    return std::move(result_);
}

void Reader::count_triangles_of_scene() {
    std::vector<std::size_t> of_mesh;
    for (std::size_t m = 0; m < document_.meshes.size(); ++m) {
        std::size_t count = 0;
        const std::vector<Primitive>& primitives = document_.meshes[m].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p)
            // A primitive of points or lines takes time, too, for each node that shows it.
            count =
                std::min(count + std::max<std::size_t>(
                                     count_triangles(primitives[p], buffers_, place_of(m, p)), 1),
                         max_triangles + 1);
        of_mesh.push_back(count);
    }
    std::size_t count = 0;
    for (const Instance& instance : instances_)
        if (const Index& mesh = document_.nodes[instance.node].mesh) {
            const std::size_t places = count_placed_meshes(document_, instance.node);
            count += of_mesh[*mesh] == 0 ? 0 : std::min(max_triangles + 1, places) * of_mesh[*mesh];
            if (count > max_triangles)
                fail("/nodes/" + std::to_string(instance.node) + "/mesh",
                     "expected a scene of at most " + std::to_string(max_triangles) +
                         " triangles and primitives in all");
        }
    if (guard_)
        guard_(bytes_per_triangle * static_cast<double>(count) +
               JsonDocument::bytes_per_character * static_cast<double>(container_.json.size()));
}

void Reader::add_materials() {
    for (const MaterialInfo& info : document_.materials) {
        const std::size_t number = result_.scene.materials.size();
        result_.scene.materials.push_back({name_or(info.name, "material", number), info.base_colour,
                                           std::numbers::pi * info.emissive});
        result_.material_source.push_back(path_ + ": /materials/" + std::to_string(number));
    }
    used_.resize(document_.materials.size());
    for (const Instance& instance : instances_)
        if (const Index& mesh = document_.nodes[instance.node].mesh)
            for (const Primitive& primitive : document_.meshes[*mesh].primitives)
                if (primitive.material && primitive.position && primitive.mode >= Mode::triangles)
                    used_[*primitive.material] = true;
    for (std::size_t m = 0; m < used_.size(); ++m)
        if (textures_ && used_[m])
            maps_.read(m, result_.scene);
}

/// Marks facets of double-sided materials, on open surfaces, as two-sided.
void Reader::mark_two_sided() {
    if (std::ranges::none_of(document_.materials, &MaterialInfo::double_sided))
        return;
    std::vector<Facet>& facets = result_.scene.facets;
    const Shells shells = find_shells(result_.scene);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::uint32_t m = facets[f].material;
        facets[f].two_sided = m < document_.materials.size() &&
                              document_.materials[m].double_sided &&
                              !shells.all[shells.of[f]].closed;
    }
}

void Reader::add_camera(const Instance& instance) {
    if (result_.camera)
        return;
    const Node& node = document_.nodes[instance.node];
    if (!document_.cameras[*node.camera].vertical_fov)
        ++orthographic_;
    result_.camera = camera_of(document_, instance);
    if (!result_.camera)
        return;
    constexpr double farthest = 0x1p52; // from where a step of 1 is a step in doubles
    if (!(glm::length(result_.camera->eye) < farthest))
        fail("/nodes/" + std::to_string(instance.node),
             "expected a transform that gives the camera a place and a direction");
    const std::string& name = document_.cameras[*node.camera].name;
    result_.camera_name = name_or(name.empty() ? node.name : name, "camera", *node.camera);
}

void Reader::add_lights() {
    const Box bounds = bounds_of(result_.scene);
    std::size_t directional = 0;
    for (const Instance& instance : instances_) {
        const Node& node = document_.nodes[instance.node];
        if (!node.light)
            continue;
        const Light& light = document_.lights[*node.light];
        const Vec3 position(instance.to_world[3]), back(instance.to_world[2]);
        const double length = glm::length(back);
        if (!(length > 0) || !(glm::length(position) <= largest_number) || !std::isfinite(length))
            fail("/nodes/" + std::to_string(instance.node),
                 "expected a transform that gives the light a place and a direction");
        add_light(result_.scene,
                  {light, position, -back / length, name_or(node.name, "light", instance.node)},
                  bounds);
        if (light.kind != Light::Kind::directional)
            continue;
        ++directional;
        result_.material_source.push_back(path_ + ": /nodes/" + std::to_string(instance.node));
    }
    warn(directional, "a directional light is a distant disc as wide as the sun",
         "directional lights are distant discs as wide as the sun");
}

void Reader::warn(std::size_t count, const std::string& one, const std::string& many) {
    if (count > 0)
        result_.warnings.push_back(path_ + ": " +
                                   (count == 1 ? one : std::to_string(count) + " " + many));
}

/// Returns what comes through a material [-]: all that alpha leaves open and, of the rest, the part
/// that is transmitted, in the base colour. Textures count by their means.
Vec3 Reader::transmittance_of(std::size_t material) {
    const MaterialInfo& info = document_.materials[material];
    if (info.is_cut_out)
        return Vec3(0.0);
    double transmission = info.transmission;
    if (transmission > 0 && info.transmission_texture && textures_)
        transmission *= maps_.mean_of_red(*info.transmission_texture);
    const Vec3 base = glm::clamp(result_.scene.materials[material].reflectance, 0.0, 1.0);
    return info.uncovered + (1 - info.uncovered) * transmission * base;
}

void Reader::find_glass() {
    for (std::uint32_t m = 0; m < used_.size(); ++m) {
        const Vec3 transmittance = used_[m] ? transmittance_of(m) : Vec3(0.0);
        if (transmittance != Vec3(0.0))
            result_.glass.push_back({m, transmittance,
                                     document_.materials[m].transmission > 0
                                         ? "KHR_materials_transmission"
                                         : "alphaMode BLEND"});
    }
    warn_of_solid_glass(result_);
}

/// Names the materials whose colours are light already.
void Reader::warn_of_unlit() {
    constexpr std::size_t max_names = 4;
    std::vector<std::string> names;
    for (std::size_t m = 0; m < used_.size(); ++m)
        if (used_[m] && document_.materials[m].unlit)
            names.push_back("'" + result_.scene.materials[m].name + "'");
    if (names.empty())
        return;
    const bool one = names.size() == 1;
    result_.warnings.push_back(
        path_ + (one ? ": material " : ": materials ") + list_names(names, max_names) +
        (one ? " is" : " are") +
        " unlit (KHR_materials_unlit), so the colours are light already: they are emitted, and "
        "nothing is reflected; to light it, give --emission 'MATERIAL=0' and --reflectance "
        "'MATERIAL=0.5', or the model as it was before its light was baked");
}

void Reader::collect_warnings(const MeshTally& meshes) {
    warn_of_unlit();
    std::size_t metals = 0, cut_out = 0;
    for (std::size_t m = 0; m < used_.size(); ++m) {
        metals += used_[m] && document_.materials[m].metallic > metal;
        cut_out += used_[m] && document_.materials[m].is_cut_out;
    }
    warn(metals, "a material is a metal; it reflects diffusely here, by its base colour",
         "materials are metals; they reflect diffusely here, by their base colours");
    warn(cut_out, "a material lets light through by a texture; it is opaque here",
         "materials let light through by textures; they are opaque here");
    find_glass();
    warn(result_.degenerate_faces, "a triangle without area is left out",
         "triangles without area are left out");
    warn(maps_.missing(),
         "a texture is not found, or neither PNG nor JPEG; the colour is its factor",
         "textures are not found, or neither PNG nor JPEG; colours are their factors");
    warn(orthographic_, "an orthographic camera is left out", "orthographic cameras are left out");
    if (!document_.unread_extensions.empty())
        result_.warnings.push_back(path_ + ": the file uses extensions that are not read: " +
                                   list_names(document_.unread_extensions));
    warn(meshes.without_coordinates, "a textured primitive has no texture coordinates",
         "textured primitives have no texture coordinates");
    warn(meshes.lines, "a primitive of points or lines is left out",
         "primitives of points or lines are left out");
    warn(meshes.coloured, "a primitive has colours of vertices, which are not read",
         "primitives have colours of vertices, which are not read");
    warn(meshes.morphed, "a primitive has morph targets, which are not read",
         "primitives have morph targets, which are not read");
    warn(meshes.skins, "a mesh has a skin; it is read in the pose in which it was modelled",
         "meshes have skins; they are read in the pose in which they were modelled");
}

} // namespace
} // namespace gltf

ReadResult read_gltf(const std::string& path, const ReadGuard& guard, bool textures,
                     Outside outside) {
    return gltf::Reader(path, guard, textures, outside).read();
}

} // namespace hemilux
