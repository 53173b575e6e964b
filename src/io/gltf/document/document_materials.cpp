// Materials, and the textures and images that they may use (sections 3.8 and 3.9).

#include "io/gltf/document/document.h"

#include <algorithm>
#include <utility>

namespace hemilux::gltf {
namespace {

std::optional<TextureInfo> read_texture(const JsonValue& owner, std::string_view key,
                                        const Document& document) {
    const std::optional<JsonValue> value = owner.find(key);
    if (!value)
        return std::nullopt;
    TextureInfo info;
    info.texture = value->at("index").index(document.textures.size(), "textures");
    constexpr std::size_t max_sets = 16;
    info.set = value->whole_or("texCoord", 0, max_sets);
    if (const auto transform = value->extension("KHR_texture_transform")) {
        std::array<double, 2> offset{0, 0}, scale{1, 1};
        transform->numbers_of("offset", offset);
        transform->numbers_of("scale", scale);
        info.offset = {offset[0], offset[1]};
        info.scale = {scale[0], scale[1]};
        info.rotation = transform->number_or("rotation", 0);
        info.set = transform->whole_or("texCoord", info.set, max_sets);
    }
    return info;
}

/// Reads numbers of at least 0; a colour may have more than the three.
template <std::size_t n>
Vec3 read_colour(const JsonValue& owner, std::string_view key, std::array<double, n> numbers) {
    owner.numbers_of(key, numbers);
    if (std::ranges::min(numbers) < 0)
        owner.at(key).fail("expected numbers of at least 0");
    return {numbers[0], numbers[1], numbers[2]};
}

/// Returns the fourth component of the base colour.
double alpha_of(const JsonValue& material) {
    std::array<double, 4> colour{1, 1, 1, 1};
    if (const auto metal = material.find("pbrMetallicRoughness"))
        metal->numbers_of("baseColorFactor", colour);
    else if (const auto diffuse = material.extension("KHR_materials_pbrSpecularGlossiness"))
        diffuse->numbers_of("diffuseFactor", colour);
    return colour[3];
}

/// Only what is no metal transmits; metallic has been read before.
void read_transmission(const JsonValue& value, const Document& document, MaterialInfo& material) {
    const std::string mode = value.text_or("alphaMode", "OPAQUE");
    if (mode == "BLEND" && !material.base_texture)
        material.uncovered = 1 - std::clamp(alpha_of(value), 0.0, 1.0);
    else
        material.is_cut_out = mode != "OPAQUE";
    if (const auto transmission = value.extension("KHR_materials_transmission")) {
        material.transmission =
            std::clamp(transmission->number_or("transmissionFactor", 0), 0.0, 1.0) *
            (1 - std::clamp(material.metallic, 0.0, 1.0));
        material.transmission_texture =
            read_texture(*transmission, "transmissionTexture", document);
    }
}

MaterialInfo read_material(const JsonValue& value, const Document& document) {
    MaterialInfo material;
    material.name = value.text_or("name", "");
    material.double_sided = value.flag_or("doubleSided", false);
    material.has_occlusion = value.find("occlusionTexture").has_value();
    if (const auto metal = value.find("pbrMetallicRoughness")) {
        material.base_colour = read_colour<4>(*metal, "baseColorFactor", {1, 1, 1, 1});
        material.metallic = metal->number_or("metallicFactor", 1);
        if (metal->find("metallicRoughnessTexture")) // which is not read
            material.metallic = 0;
        material.base_texture = read_texture(*metal, "baseColorTexture", document);
    } else if (const auto diffuse = value.extension("KHR_materials_pbrSpecularGlossiness")) {
        material.base_colour = read_colour<4>(*diffuse, "diffuseFactor", {1, 1, 1, 1});
        material.base_texture = read_texture(*diffuse, "diffuseTexture", document);
        material.metallic = 0;
    }
    material.emissive = read_colour<3>(value, "emissiveFactor", {0, 0, 0});
    material.emissive_texture = read_texture(value, "emissiveTexture", document);
    if (const auto strength = value.extension("KHR_materials_emissive_strength")) {
        const double factor = strength->number_or("emissiveStrength", 1);
        if (factor < 0)
            strength->at("emissiveStrength").fail("expected a number of at least 0");
        material.emissive *= factor;
    }
    read_transmission(value, document, material);
    material.unlit = value.extension("KHR_materials_unlit").has_value();
    if (material.unlit) {
        material.emissive = std::exchange(material.base_colour, Vec3(0.0));
        material.emissive_texture = std::exchange(material.base_texture, std::nullopt);
        material.metallic = 0;
    }
    return material;
}

Wrapping wrapping_of(const JsonValue& sampler, std::string_view key) {
    constexpr std::size_t clamp = 33071, mirror = 33648, repeat = 10497;
    const std::size_t code = sampler.whole_or(key, repeat, no_limit);
    if (code != clamp && code != mirror && code != repeat)
        sampler.at(key).fail("expected 10497, 33071 or 33648, found " + std::to_string(code));
    return code == clamp ? Wrapping::clamp : code == mirror ? Wrapping::mirror : Wrapping::repeat;
}

void read_textures(const JsonValue& root, Document& document) {
    for (const JsonValue& value : root.elements_of("images"))
        document.images.push_back(
            {value.index_in("bufferView", document.views.size(), "bufferViews"),
             value.text_or("uri", ""), value.text_or("mimeType", "")});
    const std::vector<JsonValue> samplers = root.elements_of("samplers");
    for (const JsonValue& value : root.elements_of("textures")) {
        TextureSource& texture = document.textures.emplace_back();
        if (const auto source = value.find("source"))
            texture.image = source->whole(0, no_limit);
        if (const auto webp = value.extension("EXT_texture_webp"))
            if (const auto source = webp->find("source"))
                texture.webp = source->whole(0, no_limit);
        for (const char* const kind :
             {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif"})
            texture.is_of_other_kind |= value.extension(kind).has_value();
        if (const Index sampler = value.index_in("sampler", samplers.size(), "samplers")) {
            texture.wrap_s = wrapping_of(samplers[*sampler], "wrapS");
            texture.wrap_t = wrapping_of(samplers[*sampler], "wrapT");
        }
    }
}

} // namespace

void read_materials(const JsonValue& root, Document& document) {
    read_textures(root, document);
    for (const JsonValue& value : root.elements_of("materials"))
        document.materials.push_back(read_material(value, document));
}

} // namespace hemilux::gltf
