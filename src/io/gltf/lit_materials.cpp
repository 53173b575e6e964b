#include "io/gltf/lit_materials.h"

#include "io/gltf/scene_meshes.h"
#include "radiosity/paper/scene/scene.h"

namespace hemilux::gltf {
namespace {

constexpr const char* variants_extension = "KHR_materials_variants";
constexpr const char* unlit_extension = "KHR_materials_unlit";
constexpr const char* lightmap_extension = "MOZ_lightmap";

/// Returns a material that says what is solved for a primitive without one.
Json default_material() {
    const Vec3 grey = Material().reflectance;
    return {{"name", "default"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {grey.r, grey.g, grey.b, 1}},
              {"metallicFactor", 0},
              {"roughnessFactor", 1}}}};
}

} // namespace

void LitMaterials::add(const LightmapPicture& picture) {
    std::optional<std::size_t> shown;
    if (lightmap_.binding == Binding::lit)
        shown = add_texture(picture.name + " times colours", picture.shown,
                            {{"bake", "shown"}, {"texCoord", picture.set}});
    const std::size_t texture = add_texture(
        picture.name, picture.png,
        {{"bake", lightmap_.bake}, {"texCoord", picture.set}, {"intensity", picture.intensity}});
    if (lightmap_.binding != Binding::texture)
        bind_primitives(texture, shown, picture);
}

std::size_t LitMaterials::add_texture(const std::string& name, const std::string& png,
                                      Json extras) {
    extras["exposure"] = lightmap_.exposure;
    if (!lightmap_.command.empty())
        extras["command"] = lightmap_.command;
    return document_.add_texture(name, png, std::move(extras));
}

/// Returns the material of a primitive whose light is in this picture. It is that of the file for
/// the first picture that needs it, and a copy for each other one. A primitive without a material
/// gets what was solved in its place: the format's default is a metal.
std::size_t LitMaterials::own_material(const Json& primitive, const LightmapPicture& picture) {
    std::optional<std::size_t> of_file;
    if (primitive.contains("material"))
        of_file = primitive["material"].get<std::size_t>();
    if (of_file && picture_of_.try_emplace(*of_file, &picture).first->second == &picture)
        return *of_file;
    Json& materials = document_.array_of("materials");
    const auto [found, is_new] = number_of_.try_emplace({of_file, &picture}, materials.size());
    if (is_new)
        materials.push_back(of_file ? of_file_[*of_file] : default_material());
    return found->second;
}

/// Returns the material that shows another one as it is lit. It has the other's alpha and sides.
std::size_t LitMaterials::lit_material(std::size_t own, std::size_t shown,
                                       const LightmapPicture& picture) {
    Json& materials = document_.array_of("materials");
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
void LitMaterials::add_variants(Json& primitive, std::size_t lit, std::size_t own,
                                const std::string& place) {
    Json& variants =
        document_.array_in(document_.extension_of(document_.root(), variants_extension, ""),
                           "variants", std::string("/extensions/") + variants_extension);
    if (!first_variant_) {
        first_variant_ = variants.size();
        variants.push_back({{"name", "lit"}});
        variants.push_back({{"name", "lightmap"}});
    }
    Json& mappings =
        document_.array_in(document_.extension_of(primitive, variants_extension, place), "mappings",
                           place + "/extensions/" + variants_extension);
    mappings.push_back({{"material", lit}, {"variants", {*first_variant_}}});
    mappings.push_back({{"material", own}, {"variants", {*first_variant_ + 1}}});
}

/// Returns whether viewers show a primitive as it is, whatever light arrives.
bool LitMaterials::is_unlit(const Json& primitive) const {
    if (!primitive.contains("material"))
        return false;
    const auto material = primitive["material"].get<std::size_t>();
    return source_.document().materials[material].unlit;
}

void LitMaterials::bind(Json& material, std::size_t texture, const LightmapPicture& picture) const {
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

void LitMaterials::bind_primitives(std::size_t texture, std::optional<std::size_t> shown,
                                   const LightmapPicture& picture) {
    std::set<std::size_t> used;
    bool any_lit = false;
    for (const std::size_t number : picture.origins) {
        const PrimitiveOrigin& origin = source_.origins()[number];
        Json& primitive = primitive_of_(origin);
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
        bind(document_.root()["materials"][m], texture, picture);
    if (used.empty() || lightmap_.binding == Binding::occlusion)
        return;
    if (any_lit)
        document_.use_extension(variants_extension);
    if (any_lit || lightmap_.binding == Binding::unlit)
        document_.use_extension(unlit_extension);
    if (lightmap_.binding != Binding::unlit)
        document_.use_extension(lightmap_extension);
}

} // namespace hemilux::gltf
