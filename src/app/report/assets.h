#pragma once
// The files page.html, page.css and *.js of this folder, embedded at build time.

#include <string_view>

namespace hemilux::assets {

extern const std::string_view html, style, script;

} // namespace hemilux::assets
