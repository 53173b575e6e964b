#pragma once
// Whether a patch is faced by backs of one-sided facets, seen or hidden: if it is not, no ray of it
// can end on one.

#include "geometry/box.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hemilux {

class Mesh;
struct Patch;

class FacingBacks {
  public:
    /// Where the last were found, as neighbours are faced by the same; one for each thread.
    using Last = std::array<std::size_t, 6>; ///< group, by the axis along which a patch faces most

    explicit FacingBacks(const Mesh& mesh);

    [[nodiscard]] bool face(const Patch& patch, Last& last) const;

  private:
    /// Consecutive facets, which are near each other in most files.
    struct Group {
        Box box;
        std::vector<std::uint32_t> facets; ///< those of whose backs some of the scene lies
    };
    const Mesh& mesh_;
    std::vector<Group> groups_;
};

} // namespace hemilux
