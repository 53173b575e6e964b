#pragma once
// Textures from PNG and JPEG files, each read once. Their bytes are colours by the sRGB curve.

#include "radiosity/textures/texture.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace hemilux {

/// Whether the bytes begin like a PNG or a JPEG file.
[[nodiscard]] bool is_picture_file(std::string_view bytes);

/// Decodes a picture. `place` says for messages where it stands. Throws InputError.
[[nodiscard]] Texture decode_texture(std::string_view bytes, const std::string& place);

class TextureFiles {
  public:
    /// The guard is asked before each picture is decoded, with what all of them take.
    explicit TextureFiles(const std::function<void(double bytes)>& guard) : guard_(guard) {}

    /// Empty where there is no such file or it is of another kind. Throws InputError for a picture
    /// that is broken.
    [[nodiscard]] std::shared_ptr<const Texture> read(const std::string& path);
    /// The same of bytes that are there; `key` distinguishes them from others.
    [[nodiscard]] std::shared_ptr<const Texture> decode(std::string_view bytes,
                                                        const std::string& key);

  private:
    const std::function<void(double bytes)>& guard_;
    double bytes_ = 0;
    std::map<std::string, std::shared_ptr<const Texture>> known_;
};

} // namespace hemilux
