#pragma once
// Textures from PNG, JPEG and TGA files, and WebP where hemilux was built with libwebp (webp.h),
// each read once. Their bytes are colours by the sRGB curve.

#include "radiosity/light/textures/texture.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hemilux {

/// Decodes a picture. `place` says for messages where it stands. Throws InputError.
[[nodiscard]] Texture decode_texture(std::string_view bytes, const std::string& place);

/// Returns the bytes of a zlib stream (RFC 1950); nothing where it is broken or has another number
/// of them than `size`.
[[nodiscard]] std::optional<std::string> zlib_decompressed(std::string_view packed,
                                                           std::size_t size);

class TextureFiles {
  public:
    /// The guard is called before each picture is decoded, with the bytes that all of them take.
    explicit TextureFiles(const std::function<void(double bytes)>& guard) : guard_(guard) {}

    /// Returns what was read from this path, or decoded with this key; empty where nothing was.
    [[nodiscard]] std::optional<std::shared_ptr<const Texture>>
    known(const std::string& key) const {
        const auto found = known_.find(key);
        return found == known_.end() ? std::nullopt : std::optional(found->second);
    }

    /// Reads a texture; empty where there is no such file or it is of another kind. Throws
    /// InputError for a picture that is broken.
    [[nodiscard]] std::shared_ptr<const Texture> read(const std::string& path);
    /// Does the same with bytes that are there, whose key is not known. TGA files do not say that
    /// they are such.
    [[nodiscard]] std::shared_ptr<const Texture>
    decode(std::string_view bytes, const std::string& key, bool is_tga = false);

  private:
    const std::function<void(double bytes)>& guard_;
    double bytes_ = 0;
    std::map<std::string, std::shared_ptr<const Texture>> known_;
};

} // namespace hemilux
