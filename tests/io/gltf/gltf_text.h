#pragma once
// Small glTF files for tests: numbers become a buffer within the text.

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux::test {

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i)
            bits = bits << 8 |
                   (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0u);
        for (std::size_t i = 0; i < 4; ++i)
            text += at + i > bytes.size() ? '=' : digits[bits >> (18 - 6 * i) & 63];
    }
    return text;
}

/// The bytes of numbers one after the other (tests run on little-endian machines).
template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

/// Members of a glTF file, but for its asset, buffers and views: there is one view for each item of
/// `contents`, and one buffer.
inline std::string gltf_text(const std::vector<std::string>& contents, const std::string& members) {
    std::string all, views;
    for (const std::string& content : contents) {
        all.resize((all.size() + 3) / 4 * 4);
        views += std::string(views.empty() ? "" : ",") + R"({"buffer":0,"byteOffset":)" +
                 std::to_string(all.size()) + R"(,"byteLength":)" + std::to_string(content.size()) +
                 "}";
        all += content;
    }
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":)" + std::to_string(all.size()) +
           R"(,"uri":"data:application/octet-stream;base64,)" + base64(all) +
           R"("}],"bufferViews":[)" + views + "]," + members + "}";
}

/// The same as a binary file.
inline std::string glb_of(std::string json, std::string binary) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto word = [](std::size_t value) {
        return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
    };
    return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" +
           json + word(binary.size()) + std::string("BIN\0", 4) + binary;
}

} // namespace hemilux::test
