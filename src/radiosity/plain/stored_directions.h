#pragma once
// Directions with the numbers of surfaces along them, kept in 16 bytes each: the directions as
// floats, the numbers as bytes.

#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hemilux::plain {

/// A unit vector in a patch's frame, and ns or ens of the paper: the surfaces counted along it, or
/// estimated.
struct Direction {
    Vec3 to;
    double ns;
};

class StoredDirections {
  public:
    /// Rounds the direction and keeps it as the last one.
    void add(const Vec3& to, std::uint8_t ns) {
        stored_.push_back({{float(to.x), float(to.y), float(to.z)}, ns});
    }
    [[nodiscard]] Direction at(std::size_t k) const {
        const auto& [x, y, z] = stored_[k].to;
        return {glm::normalize(Vec3(x, y, z)), double(stored_[k].ns)};
    }
    [[nodiscard]] std::size_t size() const { return stored_.size(); }
    [[nodiscard]] std::size_t bytes() const { return stored_.size() * sizeof(stored_[0]); }

  private:
    /// Rounds by being stored: in one expression g++ 12.2 -O2 leaves out the rounding to floats.
    struct Stored {
        std::array<float, 3> to;
        std::uint8_t ns;
    };
    std::vector<Stored> stored_;
};

} // namespace hemilux::plain
