#pragma once
// Bytes as text (RFC 4648, section 4), for numbers within a page.

#include <string>
#include <string_view>

namespace hemilux {

/// Returns the bytes as text, with padding. The texts of pieces whose sizes are multiples of 3 can
/// be put together.
[[nodiscard]] std::string base64(std::string_view bytes);

} // namespace hemilux
