#pragma once
// A vector of which each rank writes its own items and reads all.

#include "parallel/ranks.h"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace hemilux {

/// A vector whose items the ranks write and then gather. Ranks of one machine share it, so nothing
/// is sent and a cache that they share holds it once. Elsewhere each rank has all items. All ranks
/// make it at the same time.
template <class T>
class GatheredVector {
  public:
    explicit GatheredVector(const OwnBlocks& own)
        : own_(own), shared_(own.ranks().share_memory(own.items() * sizeof(T))),
          not_shared_(shared_ ? 0 : own.items()),
          items_(shared_ ? std::span(reinterpret_cast<T*>(shared_.get()), own.items())
                         : std::span(not_shared_)) {}
    GatheredVector(const GatheredVector&) = delete;
    GatheredVector& operator=(const GatheredVector&) = delete;

    [[nodiscard]] T& operator[](std::size_t i) { return items_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return items_[i]; }
    operator std::span<const T>() const { return items_; }

    /// Makes the items that each rank has written known to all ranks. They are written again only
    /// after another call that waits for all ranks, as others may read until then.
    void gather() {
        if (shared_)
            own_.ranks().wait_for_all();
        else
            own_.gather(items_);
    }

  private:
    OwnBlocks own_;
    std::shared_ptr<std::byte> shared_;
    std::vector<T> not_shared_;
    std::span<T> items_;
};

} // namespace hemilux
