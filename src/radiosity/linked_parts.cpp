#include "radiosity/linked_parts.h"

#include "radiosity/exchange_matrix.h"

#include <numeric>

namespace hemilux {
namespace {

/// Disjoint sets, each named by its least member (Galler and Fischer 1964; path halving).
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t n) : parent_(n) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace

LinkedParts find_linked_parts(const ExchangeMatrix& factors) {
    const auto n = static_cast<std::uint32_t>(factors.lost().size());
    DisjointSets sets(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        std::uint32_t own = sets.find(i);
        for (const MatrixEntry& entry : factors.row(i)) {
            if (entry.column > i) // the matrix is symmetric
                continue;
            const std::uint32_t other = sets.find(entry.column);
            sets.join(own, other);
            own = std::min(own, other);
        }
    }
    LinkedParts parts;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t first = sets.find(i);
        parts.of.push_back(first == i ? parts.count++ : parts.of[first]);
    }
    return parts;
}

} // namespace hemilux
