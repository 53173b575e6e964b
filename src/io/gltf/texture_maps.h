#pragma once
// The textures of materials (sections 3.8 and 3.9, KHR_texture_transform).

#include "io/gltf/elements.h"
#include "io/textures/texture_files.h"
#include "radiosity/light/textures/scene_textures.h"

#include <memory>
#include <string>
#include <vector>

namespace hemilux::gltf {

class TextureMaps {
  public:
    TextureMaps(Buffers& buffers, const ReadGuard& guard) : buffers_(buffers), files_(guard) {}

    /// Reads the textures of a material of the document, the scene's material of the same number.
    /// Its colours become their means. Throws InputError.
    void read(std::size_t material, Scene& scene);

    /// Returns the mean of the red bytes of a texture over 255, as it holds numbers and no colours;
    /// 1 where it is missing. Throws InputError.
    [[nodiscard]] double mean_of_red(const TextureInfo& info);

    /// Returns the number of sets of texture coordinates: textures use those before it.
    [[nodiscard]] std::size_t sets() const { return sets_; }
    /// Returns how many textures are not found, or of a kind that is not read.
    [[nodiscard]] std::size_t missing() const { return missing_; }
    /// Returns the paths of the pictures that were asked for.
    [[nodiscard]] const std::vector<std::string>& paths() const { return paths_; }

  private:
    void add(const TextureInfo& info, std::size_t material, Vec3 Material::*colour,
             TextureMap MaterialTextures::*map, Scene& scene);
    [[nodiscard]] std::shared_ptr<const Texture> texture_of(const TextureInfo& info);
    [[nodiscard]] std::shared_ptr<const Texture> read_image(std::size_t image);

    Buffers& buffers_;
    TextureFiles files_;
    std::size_t sets_ = 0, missing_ = 0;
    std::vector<std::string> paths_;
};

} // namespace hemilux::gltf
