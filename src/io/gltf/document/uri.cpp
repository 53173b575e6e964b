#include "io/gltf/document/uri.h"

#include "io/files/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace hemilux::gltf {
namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 0xff;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
    std::array<std::uint8_t, 256> values{};
    values.fill(no_digit);
    for (std::size_t k = 0; k < digits.size(); ++k)
        values[static_cast<unsigned char>(digits[k])] = static_cast<std::uint8_t>(k);
    return values;
}

std::optional<std::string> decode_base64(std::string_view text) {
    static constexpr std::array<std::uint8_t, 256> value = values_of_digits();
    for (int padding = 0; padding < 2 && text.ends_with('='); ++padding)
        text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::uint8_t digit = value[static_cast<unsigned char>(c)];
        if (digit == no_digit)
            return std::nullopt;
        bits = bits << 6 | digit;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes += static_cast<char>(bits >> count & 0xff);
        }
    }
    return count < 6 ? std::optional(std::move(bytes)) : std::nullopt;
}

/// Decodes %20 and the like. What is no such code stays.
std::string without_percents(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const char* const code = uri.data() + i + 1;
        unsigned char byte = 0;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(code, code + 2, byte, 16).ptr == code + 2) {
            path += static_cast<char>(byte);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// Returns the bytes of a data URI; empty for what is no base 64.
std::optional<std::string> decode_data_uri(std::string_view uri) {
    constexpr std::string_view base64 = ";base64";
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(base64))
        return std::nullopt;
    return decode_base64(uri.substr(comma + 1));
}

/// Returns the path of a URI, as seen from the folder of the scene. It is empty for other schemes
/// and absolute paths, which glTF does not allow.
std::optional<std::string> path_of_uri(std::string_view uri, const std::string& scene) {
    namespace fs = std::filesystem;
    const std::string name = without_percents(uri);
    const fs::path relative = fs::path(name).lexically_normal();
    const bool has_scheme = name.find(':') < name.find('/');
    if (name.empty() || name.find('\0') != std::string::npos || has_scheme ||
        relative.is_absolute())
        return std::nullopt;
    return (fs::path(scene).parent_path() / relative).string();
}

} // namespace

UriContent content_of_uri(std::string_view uri, const std::string& scene,
                          const std::string& place) {
    if (uri.starts_with("data:")) {
        std::optional<std::string> bytes = decode_data_uri(uri);
        if (!bytes)
            throw InputError(scene, place + ": expected data in base 64");
        return {std::move(bytes), ""};
    }
    std::optional<std::string> file = path_of_uri(uri, scene);
    if (!file)
        throw InputError(scene, place + ": expected a data URI or a path relative to this file");
    return {{}, std::move(*file)};
}

} // namespace hemilux::gltf
