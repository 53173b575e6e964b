#pragma once
// A glTF document that is being changed: its JSON, and one buffer that holds all of the file's.
// nlohmann-json takes long to compile, so that few files include this.

#include "io/gltf/lit_source.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace hemilux::gltf {

using Json = nlohmann::ordered_json;

/// Names of OpenGL's constants.
inline constexpr int vertex_target = 34962, index_target = 34963, float_component = 5126,
                     uint_component = 5125, triangles_mode = 4;

/// Returns a whole number, which may be written as 2.0; nothing for any other value.
[[nodiscard]] std::optional<std::size_t> whole_number(const Json& value);

class OpenDocument {
  public:
    /// Joins the file's buffers, and embeds the pictures that lay beside it: they would be lost
    /// where the new file lies elsewhere. Throws InputError.
    explicit OpenDocument(LitSource& source);

    [[nodiscard]] Json& root() { return root_; }
    /// Returns an array of the document, which is made where there is none.
    [[nodiscard]] Json& array_of(const char* name) { return array_in(root_, name, ""); }
    /// Returns an array of an object that stands at `place`.
    [[nodiscard]] Json& array_in(Json& object, const char* name, const std::string& place) const;
    /// Returns an extension of an object, which is made where there is none.
    [[nodiscard]] Json& extension_of(Json& object, const char* name,
                                     const std::string& place) const;
    void use_extension(const char* name);
    /// Takes an extension from the lists of those that the file uses and needs.
    void forget_extension(const char* name);

    /// Each adds bytes, or what describes them, and returns its number.
    [[nodiscard]] std::size_t add_view(std::string_view bytes);
    [[nodiscard]] std::size_t add_accessor(std::string_view bytes, int target,
                                           const Json& elements);
    /// Adds the picture of a PNG file, whose edges are not repeated.
    [[nodiscard]] std::size_t add_texture(const std::string& name, std::string_view png,
                                          Json extras);

    /// Writes a binary file. Throws OutputError.
    void write(const std::string& path);

  private:
    void join_buffers(LitSource& source);
    void embed_pictures(const LitSource& source);
    void pad() { binary_.resize((binary_.size() + 3) / 4 * 4, '\0'); }

    const std::string& path_;
    Json root_;
    std::string binary_;
    std::optional<std::size_t> sampler_;
};

} // namespace hemilux::gltf
