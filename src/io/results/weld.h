#pragma once
// Finds equal points: each is given the number of the first one that lies within a distance of it.

#include "geometry/vector.h"

#include <cstdint>
#include <vector>

namespace hemilux {

class Welder {
  public:
    explicit Welder(double distance) : distance_(distance) {}
    /// The point's number, counted from 0.
    std::uint32_t add(const Vec3& point);
    /// The point of each number.
    [[nodiscard]] std::vector<Vec3> take_points() { return std::move(points_); }

  private:
    /// Points in cells of a grid whose hashes end alike form a chain.
    [[nodiscard]] std::uint32_t find(const Vec3& point, std::uint64_t cell) const;
    void append(const Vec3& point, std::uint64_t home);
    void grow();

    double distance_;
    std::vector<Vec3> points_;
    std::vector<std::uint64_t> home_; ///< hash of each point's cell
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> first_; ///< by the last bits of the hash; a power of two
};

} // namespace hemilux
