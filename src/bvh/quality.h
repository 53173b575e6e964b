#pragma once
// Figures of merit of a tree.

#include <cstddef>

namespace hemilux {

struct BvhQuality {
    double sah_cost = 0; ///< nodes and leaves that a random line through the box visits [-]
    int depth = 0;
    std::size_t nodes = 0, leaves = 0;
    std::size_t bytes = 0; ///< all memory that the tracer holds itself
};

} // namespace hemilux
