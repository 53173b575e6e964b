#pragma once
// Names the figures that `stored-transport` finds besides the light (MethodFigures).

#include <string_view>

namespace hemilux::transport_figures {

/// The number of patches from which it traces no more random rays. None of the rays that were
/// traced has found a path to them from an emitter.
inline constexpr std::string_view unlit = "unlit";
/// The number of lit patches from which it traces no more, as no path leads from them to one that
/// has weight.
inline constexpr std::string_view unneeded = "unneeded";
/// The bytes of the rays that it keeps.
inline constexpr std::string_view bytes = "bytes_transport";

} // namespace hemilux::transport_figures
