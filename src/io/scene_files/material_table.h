#pragma once
// The materials of an OBJ file by name: used ones and those that its MTL files define, whichever
// comes first. Of several definitions of a name the first is taken.

#include "io/files/file_identity.h"
#include "io/files/outside_files.h"
#include "io/scene_files/mtl.h"
#include "io/scene_files/read_result.h"
#include "io/textures/texture_files.h"
#include "radiosity/light/textures/scene_textures.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hemilux {

class MaterialTable {
  public:
    /// `path` is that of the OBJ file; libraries are looked for in its folder. `result`, which must
    /// outlive the table, gets materials and where they stand, textures, warnings and what was
    /// read. Before a library is read, `before_library` is called with about the bytes that it will
    /// take; what it throws ends the reading. Without `read_textures`, colours are Kd and Ke alone.
    /// `outside` is the rule for libraries and textures in other folders.
    MaterialTable(const std::string& path, ReadResult& result,
                  std::function<void(double bytes)> before_library = {}, bool read_textures = true,
                  Outside outside = Outside::reported)
        : path_(path), result_(result), before_library_(std::move(before_library)),
          outside_(path, outside, result.warnings), texture_files_(before_library_),
          read_textures_(read_textures) {}

    /// Returns the material's index. `line` of the OBJ file is for messages.
    [[nodiscard]] std::uint32_t use(const std::string& name, std::size_t line);
    /// Reads what follows mtllib: a file name that may have blanks in it, or else several names. A
    /// library that is missing gives a warning. Throws InputError for one with errors.
    void read_libraries(std::string_view names, std::size_t line);
    /// Reads the textures of materials in use, and adds to the warnings what is only known at the
    /// end.
    void finish();

  private:
    struct Entry {
        std::size_t first_use = 0; ///< line of the OBJ file
        bool used = false;
        std::string redefined_in;              ///< file, which was reported
        std::string folder;                    ///< folder of its library
        std::optional<MtlMaterial> definition; ///< the first
    };
    [[nodiscard]] std::uint32_t index_of(const std::string& name);
    [[nodiscard]] std::string find_library(std::string_view name) const;
    void read_library(const std::string& file, const std::string& where);
    void define(const std::string& file, const MtlMaterial& material);
    void warn_of_undefined();
    void find_glass();
    void warn_of_surfaces();
    void add_texture(std::size_t material, const std::optional<MtlTexture>& texture,
                     Vec3 Material::*colour, TextureMap MaterialTextures::*map,
                     const std::optional<Vec3>& factor);
    [[nodiscard]] std::shared_ptr<const Texture> texture_of(std::size_t material,
                                                            const std::string& name);
    void warn_of_textures();

    std::string path_;
    ReadResult& result_;
    std::function<void(double bytes)> before_library_;
    std::set<FileIdentity> libraries_read_;
    OutsideFiles outside_;
    std::set<std::string> libraries_missed_; ///< missing libraries that were reported
    std::unordered_map<std::string, std::uint32_t> index_;
    std::vector<Entry> entries_;
    TextureFiles texture_files_;
    bool read_textures_;
    std::size_t missing_ = 0; ///< textures that are used and were not read
    std::string first_missing_;
};

} // namespace hemilux
