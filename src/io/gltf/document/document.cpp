#include "io/gltf/document/document.h"

#include <algorithm>

namespace hemilux::gltf {
namespace {

/// The extensions that are read, and those without which the geometry and its diffuse light are the
/// same.
constexpr std::array<std::string_view, 21> known_extensions{"EXT_mesh_gpu_instancing",
                                                            "KHR_animation_pointer",
                                                            "KHR_lights_punctual",
                                                            "KHR_materials_anisotropy",
                                                            "KHR_materials_clearcoat",
                                                            "KHR_materials_dispersion",
                                                            "KHR_materials_emissive_strength",
                                                            "KHR_materials_ior",
                                                            "KHR_materials_iridescence",
                                                            "KHR_materials_pbrSpecularGlossiness",
                                                            "KHR_materials_sheen",
                                                            "KHR_materials_specular",
                                                            "KHR_materials_transmission",
                                                            "KHR_materials_unlit",
                                                            "KHR_materials_variants",
                                                            "KHR_materials_volume",
                                                            "KHR_mesh_quantization",
                                                            "KHR_node_visibility",
                                                            "KHR_texture_transform",
                                                            "KHR_xmp_json_ld",
                                                            "MOZ_lightmap"};

/// Those of textures that are not read; colours are their factors then.
constexpr std::array<std::string_view, 3> texture_extensions{"EXT_texture_avif", "EXT_texture_webp",
                                                             "KHR_texture_basisu"};

void check_version(const JsonValue& root) {
    const JsonValue asset = root.at("asset");
    const std::string version = asset.at("version").text();
    if (!version.starts_with("2."))
        asset.at("version").fail("expected version 2.0, found \"" + version + "\"");
    if (const auto least = asset.find("minVersion"); least && least->text() != "2.0")
        least->fail("expected 2.0, found \"" + least->text() + "\"");
}

void check_extensions(const JsonValue& root) {
    for (const JsonValue& required : root.elements_of("extensionsRequired"))
        if (std::ranges::find(known_extensions, required.text()) == known_extensions.end() &&
            std::ranges::find(texture_extensions, required.text()) == texture_extensions.end())
            required.fail("the file requires the extension \"" + required.text() +
                          "\", which is not read; expected a file exported without it");
}

/// Returns the extensions that the file uses and that are not known, but for textures, of which
/// each that is missing is counted.
std::vector<std::string> unread_extensions(const JsonValue& root) {
    std::vector<std::string> names;
    for (const JsonValue& used : root.elements_of("extensionsUsed"))
        if (const std::string name = used.text();
            std::ranges::find(known_extensions, name) == known_extensions.end() &&
            std::ranges::find(texture_extensions, name) == texture_extensions.end())
            names.push_back(name);
    return names;
}

Primitive read_primitive(const JsonValue& value, const Document& document) {
    const std::size_t accessors = document.accessors.size();
    Primitive primitive;
    const JsonValue attributes = value.at("attributes");
    primitive.position = attributes.index_in("POSITION", accessors, "accessors");
    primitive.indices = value.index_in("indices", accessors, "accessors");
    primitive.material = value.index_in("material", document.materials.size(), "materials");
    constexpr std::size_t last_mode = static_cast<std::size_t>(Mode::fan);
    primitive.mode = static_cast<Mode>(
        value.whole_or("mode", static_cast<std::size_t>(Mode::triangles), last_mode));
    primitive.normals = attributes.index_in("NORMAL", accessors, "accessors");
    primitive.colours = attributes.index_in("COLOR_0", accessors, "accessors");
    primitive.has_targets = value.find("targets").has_value();
    for (std::size_t set = 0;; ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(set);
        const Index of_set = attributes.index_in(name, accessors, "accessors");
        if (!of_set)
            return primitive;
        primitive.texcoords.push_back(of_set);
    }
}

void read_meshes(const JsonValue& root, Document& document) {
    for (const JsonValue& value : root.elements_of("meshes")) {
        MeshInfo& mesh = document.meshes.emplace_back();
        mesh.name = value.text_or("name", "");
        for (const JsonValue& primitive : value.at("primitives").elements())
            mesh.primitives.push_back(read_primitive(primitive, document));
    }
}

void read_cameras(const JsonValue& root, Document& document) {
    constexpr double largest = 3.14;
    for (const JsonValue& value : root.elements_of("cameras")) {
        CameraInfo& camera = document.cameras.emplace_back();
        camera.name = value.text_or("name", "");
        if (value.at("type").text() != "perspective")
            continue;
        const JsonValue fov = value.at("perspective").at("yfov");
        camera.vertical_fov = fov.number();
        if (!(*camera.vertical_fov > 0 && *camera.vertical_fov < largest))
            fov.fail("expected an angle between 0 and 3.14");
    }
}

Light read_light(const JsonValue& value) {
    Light light;
    const JsonValue type = value.at("type");
    const std::string kind = type.text();
    if (kind == "spot")
        light.kind = Light::Kind::spot;
    else if (kind == "directional")
        light.kind = Light::Kind::directional;
    else if (kind != "point")
        type.fail("expected point, spot or directional, found \"" + kind + "\"");
    light.intensity = value.number_or("intensity", 1);
    std::array<double, 3> colour{1, 1, 1};
    value.numbers_of("color", colour);
    light.colour = {colour[0], colour[1], colour[2]};
    if (light.intensity < 0 || std::ranges::min(colour) < 0)
        value.fail("expected a color and an intensity of at least 0");
    if (const auto spot = value.find("spot")) {
        light.inner_cone = spot->number_or("innerConeAngle", light.inner_cone);
        light.outer_cone = spot->number_or("outerConeAngle", light.outer_cone);
        constexpr double right_angle = 1.5707964; // of a float
        if (!(light.inner_cone >= 0 && light.inner_cone <= light.outer_cone &&
              light.outer_cone > 0 && light.outer_cone <= right_angle))
            spot->fail("expected 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
    }
    return light;
}

} // namespace

Document read_document(const JsonValue& root) {
    check_version(root);
    check_extensions(root);
    Document document;
    document.unread_extensions = unread_extensions(root);
    read_buffers(root, document);
    read_materials(root, document);
    read_meshes(root, document);
    read_cameras(root, document);
    if (const auto lights = root.extension("KHR_lights_punctual"))
        for (const JsonValue& value : lights->elements_of("lights"))
            document.lights.push_back(read_light(value));
    read_nodes(root, document);
    return document;
}

} // namespace hemilux::gltf
