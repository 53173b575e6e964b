#pragma once
// The files of the folder page, embedded at build time.

#include <string_view>

namespace hemilux::assets {

extern const std::string_view style;
extern const std::string_view shared_script;              ///< script of all pages
extern const std::string_view solve_markup, solve_script; ///< page.html in frame.html, and page.js
extern const std::string_view compare_markup,
    compare_script; ///< compare.html in it, and compare.js

} // namespace hemilux::assets
