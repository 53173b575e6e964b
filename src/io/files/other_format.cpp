#include "io/files/other_format.h"

#include "io/files/text_words.h"

#include <algorithm>
#include <array>
#include <string>

namespace hemilux {
namespace {

struct Beginning {
    std::string_view text, meaning;
};

constexpr auto of_bytes = std::to_array<Beginning>({
    {"\x1f\x8b", "compressed by gzip; unpack it first"},
    {"PK\x03\x04", "a zip archive; unpack it first"},
    {"BZh", "compressed by bzip2; unpack it first"},
    {"\xfd"
     "7zXZ",
     "compressed by xz; unpack it first"},
    {"\x28\xb5\x2f\xfd", "compressed by zstd; unpack it first"},
    {"\xff\xfe", "UTF-16; save it as UTF-8 or plain text"},
    {"\xfe\xff", "UTF-16; save it as UTF-8 or plain text"},
    {"glTF", "a binary glTF model; name it .glb"},
    {"Kaydara FBX", "an FBX model; save the scene as OBJ"},
    {"BLENDER", "a Blender file; save the scene as OBJ"},
    {"\x89PNG", "a PNG picture"},
    {"%PDF", "a PDF document"},
    {"hemilux checkpoint", "a checkpoint; --resume takes it"},
});

/// The beginnings of texts, after blanks and in small letters.
constexpr auto of_text = std::to_array<Beginning>({
    {"<!doctype html", "a web page, not what was to be downloaded"},
    {"<html", "a web page, not what was to be downloaded"},
    {"<?xml", "XML, such as COLLADA or X3D; save the scene as OBJ"},
    {"ply\n", "a PLY model; save the scene as OBJ"},
    {"ply\r", "a PLY model; save the scene as OBJ"},
    {"off\n", "an OFF model; save the scene as OBJ"},
    {"#usda", "a USD scene; save the scene as OBJ"},
    {"{", "JSON; name it .gltf if it is a glTF model"},
});

/// Returns whether the content is UTF-16 without a byte order mark: one byte in two is 0.
bool is_wide(std::string_view content) {
    if (content.size() < 4)
        return false;
    const bool low = content[0] != 0 && content[1] == 0 && content[2] != 0 && content[3] == 0;
    const bool high = content[0] == 0 && content[1] != 0 && content[2] == 0 && content[3] != 0;
    return low || high;
}

} // namespace

std::string_view other_format(std::string_view content) {
    for (const auto& [text, meaning] : of_bytes)
        if (content.starts_with(text))
            return meaning;
    if (is_wide(content))
        return "UTF-16; save it as UTF-8 or plain text";
    if (content.starts_with("\xef\xbb\xbf"))
        content.remove_prefix(3);
    content.remove_prefix(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
    constexpr std::size_t enough = 16; // for the longest beginning
    const std::string begin = small_letters(content.substr(0, enough));
    for (const auto& [text, meaning] : of_text)
        if (begin.starts_with(text))
            return meaning;
    constexpr std::size_t first_lines = 1000;
    if (content.starts_with("solid") &&
        content.substr(0, first_lines).find("facet normal") != std::string_view::npos)
        return "an STL model; name it .stl";
    return {};
}

} // namespace hemilux
