#pragma once
// Packs rectangles into a square: each is placed where its upper edge is lowest on the outline of
// those before it (bottom-left with a skyline: Burke, Kendall and Whitwell 2004), turned where that
// is lower still.

#include <span>

namespace hemilux {

struct PackedRectangle {
    int width, height;
    int column = 0, row = 0; ///< place of the first corner
    bool turned = false;     ///< width and height are exchanged
};

/// Finds the places; false where they do not all fit into `side` x `side`.
[[nodiscard]] bool pack_rectangles(std::span<PackedRectangle> rectangles, int side);

} // namespace hemilux
