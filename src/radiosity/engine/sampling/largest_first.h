#pragma once
// Keeps track of the largest of many numbers, while they change one by one. It is a tree whose
// nodes hold the larger of their two children.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

namespace hemilux {

/// Holds `count` numbers that are 0 or more, and 0 at first. Each takes 16 to 32 bytes.
class LargestFirst {
  public:
    explicit LargestFirst(std::size_t count)
        : leaves_(std::bit_ceil(count)), node_(2 * leaves_, 0.0) {}

    void set(std::size_t index, double value) {
        std::size_t at = leaves_ + index;
        node_[at] = value;
        while (at > 1) {
            const double larger = std::max(node_[at], node_[at ^ 1]);
            at /= 2;
            if (node_[at] == larger) // nothing changes further up
                return;
            node_[at] = larger;
        }
    }
    [[nodiscard]] double largest() const { return node_[1]; }
    /// Returns the index of the largest number; of equal ones the first.
    [[nodiscard]] std::size_t index_of_largest() const {
        std::size_t at = 1;
        while (at < leaves_)
            at = node_[2 * at] == node_[at] ? 2 * at : 2 * at + 1;
        return at - leaves_;
    }

  private:
    std::size_t leaves_;
    std::vector<double> node_; ///< [1] is the root
};

} // namespace hemilux
