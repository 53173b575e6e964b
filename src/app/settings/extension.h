#pragma once
// What a path's extension says about the kind of file.

#include "io/files/text_words.h"

#include <filesystem>
#include <string>

namespace hemilux {

/// Returns the extension of a path with its dot, in small letters.
[[nodiscard]] inline std::string extension_of(const std::string& path) {
    return small_letters(std::filesystem::path(path).extension().string());
}

/// Returns whether the file is an OBJ file, by its name.
[[nodiscard]] inline bool is_obj(const std::string& path) { return extension_of(path) == ".obj"; }

} // namespace hemilux
