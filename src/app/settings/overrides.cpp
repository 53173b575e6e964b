#include "app/settings/overrides.h"

#include "app/settings/exit_code.h"
#include "app/settings/names.h"
#include "radiosity/light/textures/scene_textures.h"

namespace hemilux {
namespace {

void remove_texture(MaterialTextures& textures, Vec3 Material::*quantity) {
    if (quantity == &Material::emission)
        textures.tinted = false;
    (quantity == &Material::emission ? textures.emission : textures.reflectance).texture.reset();
}

} // namespace

bool matches(std::string_view pattern, std::string_view name) {
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos || pattern == name)
        return pattern == name;
    if (name.substr(0, star) != pattern.substr(0, star))
        return false;
    // The first place where the piece up to the next star fits leaves the most for the rest.
    pattern.remove_prefix(star + 1);
    name.remove_prefix(star);
    const std::size_t next = pattern.find('*');
    if (next == std::string_view::npos)
        return name.ends_with(pattern);
    const std::size_t at = name.find(pattern.substr(0, next));
    return at != std::string_view::npos && matches(pattern.substr(next), name.substr(at + next));
}

std::optional<Override> parse_override(std::string_view text, const NumberRange& range) {
    // The value has no '='; a material's name may.
    const std::size_t equals = text.rfind('=');
    if (equals == std::string_view::npos || equals == 0)
        return std::nullopt;
    const std::optional<Vec3> value = parse_colour(text.substr(equals + 1), range);
    if (!value)
        return std::nullopt;
    return Override{std::string(text.substr(0, equals)), *value};
}

void apply_overrides(Scene& scene, Vec3 Material::*quantity,
                     const std::vector<Override>& overrides) {
    for (const auto& [name, value] : overrides) {
        bool found = false;
        for (std::size_t m = 0; m < scene.materials.size(); ++m) {
            Material& material = scene.materials[m];
            if (!matches(name, material.name))
                continue;
            material.*quantity = value;
            if (scene.colours_vary_on(static_cast<std::uint32_t>(m)))
                remove_texture(own_textures_of(scene).of_material[m], quantity);
            found = true;
        }
        if (found)
            continue;
        std::vector<std::string> known;
        for (const Material& material : scene.materials)
            known.push_back(material.name);
        throw UsageError(unknown_name("material", name, known));
    }
}

} // namespace hemilux
