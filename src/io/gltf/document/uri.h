#pragma once
// What a glTF file refers to: bytes within the text (RFC 2397, in base 64), or a file beside it.

#include "io/scene_files/read_result.h"

#include <optional>
#include <string>
#include <string_view>

namespace hemilux::gltf {

/// The bytes of a data URI; empty for any other URI and for what is no base 64.
[[nodiscard]] std::optional<std::string> decode_data_uri(std::string_view uri);
[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The path of a file that a relative URI names, seen from the folder of the scene. Empty for other
/// schemes and absolute paths, which glTF does not allow.
[[nodiscard]] std::optional<std::string> path_of_uri(std::string_view uri,
                                                     const std::string& scene);

} // namespace hemilux::gltf
