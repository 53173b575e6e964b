#pragma once
// Disjoint sets of numbers, each named by its least member (Galler and Fischer 1964; path halving).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hemilux {

class DisjointSets {
  public:
    /// Begins with a set for each number below n.
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    /// Returns the least member of the set that i is in.
    [[nodiscard]] std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// Makes one set of those of i and j.
    void join(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t a = find(i), b = find(j);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace hemilux
