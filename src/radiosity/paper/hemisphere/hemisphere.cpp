#include "radiosity/paper/hemisphere/hemisphere.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace hemilux {
namespace {

using Corners = std::array<std::uint16_t, 3>;

Hemisphere::Cell make_cell(const Corners& vertex, std::uint8_t level,
                           const std::vector<Vec3>& vertices) {
    const SphericalTriangle shape(vertices[vertex[0]], vertices[vertex[1]], vertices[vertex[2]]);
    return {vertex, {}, 0, level, shape.solid_angle(), shape.projected_solid_angle(), shape};
}

/// The midpoints by the pair of vertices of their edge, so that neighbours share them exactly.
class Midpoints {
  public:
    explicit Midpoints(std::vector<Vec3>& vertices) : vertices_(vertices) {}
    std::uint16_t of(std::uint16_t a, std::uint16_t b) {
        const auto next = static_cast<std::uint16_t>(vertices_.size());
        const auto [place, is_new] = known_.try_emplace(std::minmax(a, b), next);
        if (is_new)
            vertices_.push_back(glm::normalize(vertices_[a] + vertices_[b]));
        return place->second;
    }

  private:
    std::vector<Vec3>& vertices_;
    std::map<std::pair<std::uint16_t, std::uint16_t>, std::uint16_t> known_;
};

} // namespace

Hemisphere::Hemisphere(int depth) : depth_(depth) {
    if (!(depth >= 0 && depth <= max_depth))
        throw std::invalid_argument("depth of the hemisphere's subdivision is " +
                                    std::to_string(depth) + ", expected 0 to " +
                                    std::to_string(max_depth));
    cells_.reserve(cells_up_to(depth));
    vertices_ = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    for (const Corners root : {Corners{0, 1, 2}, Corners{0, 2, 3}, {0, 3, 4}, {0, 4, 1}})
        cells_.push_back(make_cell(root, 0, vertices_));

    Midpoints midpoints(vertices_);
    for (std::size_t i = 0; cells_.size() < cells_up_to(depth); ++i) {
        Cell& cell = cells_[i];
        const auto [a, b, c] = cell.vertex;
        const std::uint16_t ab = midpoints.of(a, b), bc = midpoints.of(b, c),
                            ca = midpoints.of(c, a);
        cell.midpoint = {ab, bc, ca};
        cell.first_child = static_cast<std::uint16_t>(cells_.size());
        cuts_.push_back({glm::cross(vertices_[ab], vertices_[ca]),
                         glm::cross(vertices_[bc], vertices_[ab]),
                         glm::cross(vertices_[ca], vertices_[bc])});
        const auto level = static_cast<std::uint8_t>(cell.level + 1);
        for (const Corners child : {Corners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
            cells_.push_back(make_cell(child, level, vertices_));
    }
}

std::uint16_t Hemisphere::leaf_at(const Vec3& direction) const {
    const bool left = direction.x < 0;
    std::size_t cell = direction.y >= 0 ? (left ? 1 : 0) : (left ? 2 : 3);
    while (cell < cuts_.size()) {
        const auto cuts = [&](std::size_t side) {
            return glm::dot(cuts_[cell][side], direction) > 0;
        };
        cell = cells_[cell].first_child + (cuts(0) ? 0u : cuts(1) ? 1u : cuts(2) ? 2u : 3u);
    }
    return static_cast<std::uint16_t>(cell);
}

} // namespace hemilux
