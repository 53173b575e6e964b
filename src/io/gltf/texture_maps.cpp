#include "io/gltf/texture_maps.h"

#include "geometry/elementary.h"
#include "io/files/error.h"
#include "io/files/input_file.h"
#include "io/gltf/document/uri.h"
#include "radiosity/light/textures/scene_textures.h"

#include <algorithm>
#include <array>

namespace hemilux::gltf {

void TextureMaps::read(std::size_t material, Scene& scene) {
    const MaterialInfo& info = buffers_.document().materials[material];
    if (info.base_texture)
        add(*info.base_texture, material, &Material::reflectance, &MaterialTextures::reflectance,
            scene);
    if (info.emissive_texture)
        add(*info.emissive_texture, material, &Material::emission, &MaterialTextures::emission,
            scene);
}

/// Adds a texture with the transform of KHR_texture_transform: scale, then rotation, then offset.
void TextureMaps::add(const TextureInfo& info, std::size_t material, Vec3 Material::*colour,
                      TextureMap MaterialTextures::*map, Scene& scene) {
    std::shared_ptr<const Texture> texture = texture_of(info);
    if (!texture)
        return;
    const TextureSource& source = buffers_.document().textures[info.texture];
    const auto wrap_of = [](Wrapping wrapping) {
        return wrapping == Wrapping::clamp    ? Wrap::clamp
               : wrapping == Wrapping::mirror ? Wrap::mirror
                                              : Wrap::repeat;
    };
    SceneTextures& textures = own_textures_of(scene);
    textures.of_material.resize(buffers_.document().materials.size());
    TextureMap& to = textures.of_material[material].*map;
    to.texture = std::move(texture);
    to.wraps = {wrap_of(source.wrap_s), wrap_of(source.wrap_t)};
    to.set = static_cast<std::uint32_t>(info.set);
    const double c = elementary::cos(info.rotation), s = elementary::sin(info.rotation);
    to.origin = info.offset;
    to.x = info.scale.x * Vec2(c, -s);
    to.y = info.scale.y * Vec2(s, c);
    Vec3& of_material = scene.materials[material].*colour;
    to.factor = of_material;
    of_material *= to.texture->mean();
    sets_ = std::max(sets_, info.set + 1);
}

double TextureMaps::mean_of_red(const TextureInfo& info) {
    const std::shared_ptr<const Texture> texture = texture_of(info);
    if (!texture)
        return 1;
    const std::array<double, 256>& linear = srgb_to_linear();
    double sum = 0;
    for (std::uint32_t y = 0; y < texture->height(); ++y)
        for (std::uint32_t x = 0; x < texture->width(); ++x) {
            const Vec2 place((x + .5) / texture->width(), (y + .5) / texture->height());
            const double light = texture->texel_at(place, {}).r;
            sum += static_cast<double>(std::ranges::lower_bound(linear, light) - linear.begin());
        }
    constexpr double white = 255;
    return sum / (white * texture->width() * texture->height());
}

/// Returns a texture; empty, and counted, where it is missing or of a kind that is not read.
std::shared_ptr<const Texture> TextureMaps::texture_of(const TextureInfo& info) {
    const Document& document = buffers_.document();
    const TextureSource& source = document.textures[info.texture];
    const Index image = source.image ? source.image : source.webp;
    if (image ? *image >= document.images.size() : !source.is_of_other_kind)
        throw InputError(buffers_.path(), "/textures/" + std::to_string(info.texture) +
                                              "/source: expected an image below " +
                                              std::to_string(document.images.size()));
    std::shared_ptr<const Texture> texture;
    if (image)
        texture = read_image(*image);
    missing_ += texture ? 0 : 1;
    return texture;
}

/// Returns the image; empty where it is missing or of a kind that is not read.
std::shared_ptr<const Texture> TextureMaps::read_image(std::size_t image) {
    const ImageInfo& info = buffers_.document().images[image];
    const std::string place = "/images/" + std::to_string(image);
    const std::string key = buffers_.path() + ": " + place;
    if (const auto texture = files_.known(key))
        return *texture;
    if (info.view)
        return files_.decode(buffers_.view(*info.view), key);
    const auto [bytes, file] = content_of_uri(info.uri, buffers_.path(), place + "/uri");
    if (bytes)
        return files_.decode(*bytes, key);
    paths_.push_back(file);
    if (is_input(file, InputKind::regular))
        buffers_.check_outside(file, place, "texture");
    return files_.read(file);
}

} // namespace hemilux::gltf
