#pragma once
// The materials of a glTF file that is written with its light: those of the file, and with
// Binding::lit others that any viewer shows as they are lit.

#include "io/gltf/lit_file.h"
#include "io/gltf/open_document.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace hemilux::gltf {

class LitMaterials {
  public:
    /// `primitive_of` returns the primitive that is written for an origin.
    LitMaterials(OpenDocument& document, const LitSource& source, const LightmapOfFile& lightmap,
                 std::function<Json&(const PrimitiveOrigin&)> primitive_of)
        : document_(document), source_(source), lightmap_(lightmap),
          primitive_of_(std::move(primitive_of)),
          of_file_(document.root().value("materials", Json::array())) {}

    /// Adds the textures of a picture, and binds them to the materials of its primitives. What
    /// viewers show as it is stays so where others are shown as they are lit.
    void add(const LightmapPicture& picture);

  private:
    using Lit =
        std::pair<std::optional<std::size_t>, const LightmapPicture*>; ///< none: the default

    [[nodiscard]] std::size_t add_texture(const std::string& name, const std::string& png,
                                          Json extras);
    void bind_primitives(std::size_t texture, std::optional<std::size_t> shown,
                         const LightmapPicture& picture);
    void bind(Json& material, std::size_t texture, const LightmapPicture& picture) const;
    [[nodiscard]] bool is_unlit(const Json& primitive) const;
    [[nodiscard]] std::size_t own_material(const Json& primitive, const LightmapPicture& picture);
    [[nodiscard]] std::size_t lit_material(std::size_t own, std::size_t shown,
                                           const LightmapPicture& picture);
    void add_variants(Json& primitive, std::size_t lit, std::size_t own, const std::string& place);

    OpenDocument& document_;
    const LitSource& source_;
    const LightmapOfFile& lightmap_;
    std::function<Json&(const PrimitiveOrigin&)> primitive_of_;
    const Json of_file_;
    std::map<std::size_t, const LightmapPicture*> picture_of_; ///< that a material is kept for
    std::map<Lit, std::size_t> number_of_;      ///< where it is another one than in the file
    std::map<std::size_t, std::size_t> lit_of_; ///< material that shows another one lit
    std::set<const Json*> bound_;               ///< primitives that have their materials
    std::optional<std::size_t> first_variant_;  ///< its number: lit; the next one is as in the file
};

} // namespace hemilux::gltf
