#include "io/lightmaps/joined_charts.h"

#include <cstddef>
#include <map>
#include <numeric>
#include <tuple>

namespace hemilux {
namespace {

/// Sets of triangles that are joined (union and find).
class Joined {
  public:
    explicit Joined(std::size_t count) : of_(count) {
        std::iota(of_.begin(), of_.end(), std::size_t{0});
    }
    std::size_t find(std::size_t k) {
        while (of_[k] != k)
            k = of_[k] = of_[of_[k]];
        return k;
    }
    void join(std::size_t a, std::size_t b) { of_[find(b)] = find(a); }

  private:
    std::vector<std::size_t> of_;
};

} // namespace

void join_charts(const Mesh& mesh, std::vector<PlacedTriangle>& triangles) {
    using End = std::tuple<double, double, double, double, double>;
    std::map<End, std::size_t> at;
    Joined joined(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto corners = corners_of(mesh, triangles[t]);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Vec2& place = triangles[t].place[k];
            const auto [found, is_new] =
                at.try_emplace(End(place.x, place.y, corners[k].x, corners[k].y, corners[k].z), t);
            if (!is_new)
                joined.join(found->second, t);
        }
    }
    for (std::size_t t = 0; t < triangles.size(); ++t)
        triangles[t].chart = static_cast<std::uint32_t>(joined.find(t));
}

} // namespace hemilux
