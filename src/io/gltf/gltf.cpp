#include "io/gltf/gltf.h"

#include "io/files/error.h"
#include "io/files/text_words.h"
#include "io/gltf/lights.h"
#include "io/gltf/primitives.h"
#include "io/gltf/texture_maps.h"
#include "io/polygons/polygon_division.h"
#include "io/scene_files/emitter_shapes.h"
#include "radiosity/sides/shells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

namespace hemilux {
namespace gltf {
namespace {

/// A few nodes may show one mesh very often; no more patches than these can be solved anyway.
constexpr std::size_t most_triangles = 50'000'000;
/// Memory that a triangle takes with its corners, while it is read.
constexpr double bytes_per_triangle = 200;
/// A material is called a metal from here on.
constexpr double metal = 0.5;

/// A node of the scene with its transform to the world.
struct Instance {
    std::size_t node;
    glm::dmat4 to_world;
};

std::string name_or(const std::string& name, const char* kind, std::size_t number) {
    return name.empty() ? kind + (" " + std::to_string(number)) : name;
}

class Reader {
  public:
    Reader(const std::string& path, const ReadGuard& guard, bool textures)
        : path_(path), guard_(guard), textures_(textures), container_(read_container(path, guard)),
          json_(container_.json, path), document_(read_document(json_.root())),
          buffers_(document_, container_, path_, guard_), maps_(buffers_, guard_),
          triangles_(buffers_) {}

    ReadResult read();

  private:
    void find_instances();
    void count_triangles_of_scene();
    void add_materials();
    void add_texcoords(const Primitive& primitive, const Triangles& triangles,
                       const std::array<std::uint32_t, 3>& corners);
    void mark_two_sided();
    void add_mesh(const Instance& instance);
    void add_primitive(const Instance& instance, std::size_t mesh, std::size_t number,
                       std::uint32_t group);
    [[nodiscard]] const Triangles& triangles_of(std::size_t mesh, std::size_t number);
    [[nodiscard]] std::uint32_t group_of(const std::string& name);
    [[nodiscard]] std::uint32_t default_material();
    void add_camera(const Instance& instance);
    void add_lights();
    void collect_warnings();
    void warn(std::size_t count, const std::string& one, const std::string& many);
    [[noreturn]] void fail(const std::string& place, const std::string& message) const {
        throw InputError(path_, place + ": " + message);
    }
    [[nodiscard]] static std::string place_of(std::size_t mesh, std::size_t primitive) {
        return "/meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(primitive);
    }

    std::string path_;
    const ReadGuard& guard_;
    bool textures_;
    Container container_;
    JsonDocument json_;
    Document document_;
    Buffers buffers_;
    TextureMaps maps_;
    TriangleReader triangles_;
    std::vector<Instance> instances_;
    std::unordered_map<std::string, std::uint32_t> group_index_;
    /// By mesh and primitive, read when a node shows them first.
    std::unordered_map<std::size_t, std::vector<std::optional<Triangles>>> read_;
    std::vector<bool> used_; ///< materials
    std::optional<std::uint32_t> default_material_;
    std::size_t without_coordinates_ = 0, lines_ = 0, coloured_ = 0, morphed_ = 0, skins_ = 0;
    PolygonDivision division_;
    std::vector<Vec3> world_;
    ReadResult result_;
};

ReadResult Reader::read() {
    find_instances();
    count_triangles_of_scene();
    add_materials();
    result_.scene.textures.texcoords.resize(maps_.sets());
    for (const Instance& instance : instances_) {
        const Node& node = document_.nodes[instance.node];
        if (node.mesh)
            add_mesh(instance);
        if (node.camera)
            add_camera(instance);
    }
    if (result_.scene.facets.empty())
        throw InputError(path_, result_.scene.faces > 0
                                    ? "none of the triangles has an area"
                                    : "no triangles; expected a scene whose nodes show meshes");
    mark_two_sided();
    add_lights();
    for (std::vector<Texcoords>& set : result_.scene.textures.texcoords)
        set.resize(result_.scene.facets.size());
    collect_warnings();
    result_.textures = maps_.paths();
    result_.libraries = buffers_.files();
    return std::move(result_);
}

/// From the roots on, without recursion: a chain of nodes may be long.
void Reader::find_instances() {
    std::vector<Instance> open;
    for (const std::size_t root : document_.roots)
        open.push_back({root, glm::dmat4(1.0)});
    std::ranges::reverse(open);
    while (!open.empty()) {
        Instance instance = open.back();
        open.pop_back();
        const Node& node = document_.nodes[instance.node];
        instance.to_world = instance.to_world * node.transform;
        instances_.push_back(instance);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            open.push_back({*child, instance.to_world});
    }
}

void Reader::count_triangles_of_scene() {
    std::vector<std::size_t> of_mesh;
    for (std::size_t m = 0; m < document_.meshes.size(); ++m) {
        std::size_t count = 0;
        const std::vector<Primitive>& primitives = document_.meshes[m].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p)
            count = std::min(count + count_triangles(primitives[p], buffers_, place_of(m, p)),
                             most_triangles + 1);
        of_mesh.push_back(count);
    }
    std::size_t count = 0;
    for (const Instance& instance : instances_)
        if (const Index& mesh = document_.nodes[instance.node].mesh) {
            count += of_mesh[*mesh];
            if (count > most_triangles)
                fail("/nodes/" + std::to_string(instance.node) + "/mesh",
                     "expected a scene of at most " + std::to_string(most_triangles) +
                         " triangles in all");
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

void Reader::add_texcoords(const Primitive& primitive, const Triangles& triangles,
                           const std::array<std::uint32_t, 3>& corners) {
    for (std::size_t set = 0; set < maps_.sets(); ++set) {
        Texcoords& to = result_.scene.textures.texcoords[set].emplace_back();
        to.fill(glm::vec2(0.0f));
        if (set < std::min(triangles.texcoords.size(), primitive.texcoords.size()))
            for (std::size_t k = 0; k < 4; ++k)
                to[k] = triangles.texcoords[set][corners[std::min<std::size_t>(k, 2)]];
    }
}

/// Facets of double-sided materials, on open surfaces.
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

std::uint32_t Reader::group_of(const std::string& name) {
    const auto next = static_cast<std::uint32_t>(result_.scene.groups.size());
    const auto [found, is_new] = group_index_.try_emplace(name, next);
    if (is_new)
        result_.scene.groups.push_back(name);
    return found->second;
}

/// Of primitives without one: as of an OBJ file that names none.
std::uint32_t Reader::default_material() {
    if (!default_material_) {
        default_material_ = static_cast<std::uint32_t>(result_.scene.materials.size());
        result_.scene.materials.emplace_back().name = "default";
        result_.material_source.emplace_back();
    }
    return *default_material_;
}

const Triangles& Reader::triangles_of(std::size_t mesh, std::size_t number) {
    const std::vector<Primitive>& primitives = document_.meshes[mesh].primitives;
    std::vector<std::optional<Triangles>>& of_mesh = read_[mesh];
    of_mesh.resize(primitives.size());
    if (!of_mesh[number])
        of_mesh[number] =
            triangles_.read(primitives[number], place_of(mesh, number),
                            std::min(maps_.sets(), primitives[number].texcoords.size()));
    return *of_mesh[number];
}

void Reader::add_mesh(const Instance& instance) {
    const Node& node = document_.nodes[instance.node];
    const MeshInfo& mesh = document_.meshes[*node.mesh];
    const std::uint32_t group =
        group_of(!node.name.empty() ? node.name : name_or(mesh.name, "node", instance.node));
    skins_ += node.has_skin;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
        add_primitive(instance, *node.mesh, p, group);
}

void Reader::add_primitive(const Instance& instance, std::size_t mesh, std::size_t number,
                           std::uint32_t group) {
    const Primitive& primitive = document_.meshes[mesh].primitives[number];
    lines_ += primitive.mode < Mode::triangles;
    coloured_ += primitive.has_colours;
    morphed_ += primitive.has_targets;
    if (!primitive.position || primitive.mode < Mode::triangles)
        return;
    const Triangles& triangles = triangles_of(mesh, number);
    const std::uint32_t material =
        primitive.material ? static_cast<std::uint32_t>(*primitive.material) : default_material();
    without_coordinates_ +=
        result_.scene.textures.on(material) && primitive.texcoords.size() < maps_.sets();
    Scene& scene = result_.scene;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    world_.clear();
    for (const Vec3& point : triangles.points) {
        const Vec3 world(instance.to_world * glm::dvec4(point, 1.0));
        if (!(std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) <=
              largest_number))
            fail("/nodes/" + std::to_string(instance.node),
                 "expected a transform that leaves all places within 1e100");
        world_.push_back(world);
    }
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
    }
    scene.vertices.insert(scene.vertices.end(), world_.begin(), world_.end());
}

/// It looks along -z of its node, and y is up there (section 3.10.3).
void Reader::add_camera(const Instance& instance) {
    const CameraInfo& camera = document_.cameras[*document_.nodes[instance.node].camera];
    const Vec3 eye(instance.to_world[3]), back(instance.to_world[2]), up(instance.to_world[1]);
    const double length = glm::length(back);
    if (result_.camera || !camera.vertical_fov || !(length > 0 && glm::length(up) > 0) ||
        !std::isfinite(length + glm::length(eye) + glm::length(up)))
        return;
    result_.camera = Camera{.eye = eye,
                            .target = eye - back / length,
                            .up = glm::normalize(up),
                            .vertical_fov_degrees = *camera.vertical_fov * 180 / std::numbers::pi};
    result_.camera_name =
        name_or(camera.name.empty() ? document_.nodes[instance.node].name : camera.name, "camera",
                *document_.nodes[instance.node].camera);
}

void Reader::add_lights() {
    const Box bounds = bounds_of(result_.scene);
    std::array<std::size_t, 3> count{};
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
        ++count[static_cast<std::size_t>(light.kind)];
        add_light(result_.scene,
                  {light, position, -back / length, name_or(node.name, "light", instance.node)},
                  bounds);
        result_.material_source.push_back(path_ + ": /nodes/" + std::to_string(instance.node));
    }
    warn(count[0], "a point light is a small emitter of the same flux",
         "point lights are small emitters of the same flux");
    warn(count[1], "a spot light is a small disc of the same flux, which shines by the cosine law",
         "spot lights are small discs of the same flux, which shine by the cosine law");
    warn(count[2], "a directional light is a distant disc as wide as the sun",
         "directional lights are distant discs as wide as the sun");
}

void Reader::warn(std::size_t count, const std::string& one, const std::string& many) {
    if (count > 0)
        result_.warnings.push_back(path_ + ": " +
                                   (count == 1 ? one : std::to_string(count) + " " + many));
}

void Reader::collect_warnings() {
    std::size_t metals = 0, transparent = 0;
    for (std::size_t m = 0; m < used_.size(); ++m) {
        metals += used_[m] && document_.materials[m].metallic > metal;
        transparent += used_[m] && document_.materials[m].transparent;
    }
    warn(metals, "a material is a metal; it reflects diffusely here, by its base colour",
         "materials are metals; they reflect diffusely here, by their base colours");
    warn(transparent, "a material is transparent; it is opaque here",
         "materials are transparent; they are opaque here");
    warn(result_.degenerate_faces, "a triangle without area is left out",
         "triangles without area are left out");
    warn(maps_.missing(),
         "a texture is not found, or neither PNG nor JPEG; the colour is its factor",
         "textures are not found, or neither PNG nor JPEG; colours are their factors");
    warn(without_coordinates_, "a textured primitive has no texture coordinates",
         "textured primitives have no texture coordinates");
    warn(lines_, "a primitive of points or lines is left out",
         "primitives of points or lines are left out");
    warn(coloured_, "a primitive has colours of vertices, which are not read",
         "primitives have colours of vertices, which are not read");
    warn(morphed_, "a primitive has morph targets, which are not read",
         "primitives have morph targets, which are not read");
    warn(skins_, "a mesh has a skin; it is read in the pose in which it was modelled",
         "meshes have skins; they are read in the pose in which they were modelled");
}

} // namespace
} // namespace gltf

ReadResult read_gltf(const std::string& path, const ReadGuard& guard, bool textures) {
    return gltf::Reader(path, guard, textures).read();
}

} // namespace hemilux
