#pragma once
// The things that a glTF file refers to: bytes within the text (RFC 2397, in base 64), or a file
// beside it.

#include <optional>
#include <string>
#include <string_view>

namespace hemilux::gltf {

struct UriContent {
    std::optional<std::string> bytes; ///< content of a data URI
    std::string file;                 ///< the path of any other
};

/// Returns what a URI of the file `scene` refers to. `place` is where it stands, such as
/// /images/3/uri. Throws InputError for data that are no base 64, for other schemes and for
/// absolute paths, which glTF does not allow.
[[nodiscard]] UriContent content_of_uri(std::string_view uri, const std::string& scene,
                                        const std::string& place);

} // namespace hemilux::gltf
