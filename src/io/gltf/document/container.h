#pragma once
// The two containers of glTF 2.0 (sections 3.3 and 4.4 of its specification): JSON as a text, or a
// binary file that holds the JSON and one buffer.

#include "io/scene_files/read_result.h"

#include <optional>
#include <string>
#include <string_view>

namespace hemilux::gltf {

/// The chunks of a file. The views refer to `content`.
struct Container {
    std::string content;
    std::string_view json;
    std::optional<std::string_view> binary; ///< the first buffer of a binary file
    std::string warning = {};               ///< what is not read; empty: nothing
};

/// Reads a file. Throws InputError for one that cannot be read or whose lengths contradict each
/// other.
[[nodiscard]] Container read_container(const std::string& path, const ReadGuard& guard);

} // namespace hemilux::gltf
