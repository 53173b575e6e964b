#pragma once
// What a path's extension says about the kind of file.

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace hemilux {

/// The extension of a path with its dot, in small letters.
[[nodiscard]] inline std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

} // namespace hemilux
