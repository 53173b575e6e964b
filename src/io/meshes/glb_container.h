#pragma once
// The binary container of glTF 2.0 (section 4.4 of its specification), written.

#include <span>
#include <string>
#include <string_view>

namespace hemilux {

/// Writes a .glb file of this JSON and one buffer, which is the parts one after the other, a
/// multiple of 4 bytes in all. Throws OutputError.
void write_glb_container(const std::string& path, std::string json,
                         std::span<const std::string_view> buffer);

} // namespace hemilux
