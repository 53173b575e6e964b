#include "radiosity/research/guiding/pyramids.h"

#include "parallel/workers.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solving/solver.h"
#include "radiosity/research/guiding/log_byte.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace hemilux {

Pyramid::Place Pyramid::place_of(const Box& box) const {
    const Vec3 centre = box.centre() - apex, half = 0.5 * box.extent();
    Place place = Place::inside;
    for (const Vec3& n : normal) {
        const double middle = glm::dot(n, centre), reach = glm::dot(glm::abs(n), half);
        if (middle + reach <= min_distance)
            return Place::outside;
        if (middle - reach <= min_distance)
            place = Place::across;
    }
    return place;
}

/// Clips the polygon by one plane after the other (Sutherland and Hodgman 1974); the mean of the
/// corners that are left lies inside, as all is convex.
std::optional<Vec3> Pyramid::point_of(const Polygon& polygon) const {
    constexpr std::size_t max_corners = 4 + 3;
    std::array<Vec3, max_corners> corner, kept;
    std::size_t corners = polygon.corner.size();
    std::ranges::copy(polygon.corner, corner.begin());
    for (const Vec3& n : normal) {
        std::size_t left = 0;
        const auto height = [&](const Vec3& p) { return glm::dot(n, p - apex) - min_distance; };
        for (std::size_t k = 0; k < corners; ++k) {
            const Vec3 &a = corner[k], &b = corner[(k + 1) % corners];
            const double of_a = height(a), of_b = height(b);
            if (of_a > 0)
                kept[left++] = a;
            if ((of_a > 0) != (of_b > 0))
                kept[left++] = glm::mix(a, b, of_a / (of_a - of_b));
        }
        if (left == 0)
            return std::nullopt;
        corners = left;
        std::swap(corner, kept);
    }
    Vec3 sum(0.0);
    for (std::size_t k = 0; k < corners; ++k)
        sum += corner[k];
    return sum / static_cast<double>(corners);
}

/// Counts the patches in pyramids, from one patch after another.
class PyramidMap::Count {
  public:
    Count(const Mesh& mesh, const PatchBoxes& boxes, const Hemisphere& hemisphere, double threshold)
        : mesh_(mesh), boxes_(boxes), hemisphere_(hemisphere), threshold_(threshold) {}

    /// Writes a byte for each triangle that exists.
    void count(std::uint32_t patch, std::uint8_t* counts) {
        apex_ = mesh_.patches()[patch].centre;
        frame_ = mesh_.hemisphere_frame(patch);
        counts_ = counts;
        found_.clear();
        if (!boxes_.nodes().empty())
            found_.push_back(0);
        const std::size_t all = found_.size();
        for (std::size_t root = 0; root < Hemisphere::cells_up_to(0); ++root)
            visit(root, 0, all);
    }

  private:
    /// Counts what lies in a triangle's pyramid, and in those of its children. The nodes
    /// found_[begin] to before found_[end] hold all that may lie in it.
    void visit(std::size_t cell, std::size_t begin, std::size_t end) {
        const Hemisphere::Cell& triangle = hemisphere_.cells()[cell];
        Pyramid pyramid{apex_, triangle.shape.planes()};
        for (Vec3& n : pyramid.normal)
            n = frame_.to_world(n);
        std::uint32_t patches = 0;
        for (std::size_t k = begin; k < end; ++k)
            patches += find(found_[k], pyramid);
        const std::size_t own_end = found_.size();
        counts_[cell] = log_byte::from(patches);
        if (triangle.level < hemisphere_.depth() &&
            is_divided(log_byte::value(counts_[cell]), threshold_))
            for (std::size_t child = 0; child < 4; ++child)
                visit(triangle.first_child + child, end, own_end);
        found_.resize(end);
    }

    /// Adds to found_ the parts of a node that lie in the pyramid; returns their number of patches.
    std::uint32_t find(std::uint32_t at, const Pyramid& pyramid) {
        const PatchBoxes::Node& node = boxes_.nodes()[at];
        const Pyramid::Place place = pyramid.place_of(node.box);
        if (place == Pyramid::Place::outside)
            return 0;
        if (place == Pyramid::Place::across && node.patches() > 1)
            return find(at + 1, pyramid) + find(node.second, pyramid);
        if (place == Pyramid::Place::across &&
            !pyramid.point_of(mesh_.patches()[boxes_.patch(node.first)].shape))
            return 0;
        found_.push_back(at);
        return node.patches();
    }

    const Mesh& mesh_;
    const PatchBoxes& boxes_;
    const Hemisphere& hemisphere_;
    double threshold_;
    Vec3 apex_{0.0};
    Frame frame_{};
    std::uint8_t* counts_ = nullptr;
    std::vector<std::uint32_t> found_; ///< a stack: of each triangle on the way from the root
};

PyramidMap::PyramidMap(const Mesh& mesh, const Hemisphere& hemisphere, double threshold,
                       const Workers& workers, Monitor& monitor, const Needs& needs)
    : hemisphere_(hemisphere), threshold_(threshold),
      counts_(mesh.patches().size() * hemisphere.cells().size()) {
    const PatchBoxes boxes(mesh);
    workers.for_chunks(mesh.patches().size(), 16, [&](std::size_t begin, std::size_t end) {
        Count from(mesh, boxes, hemisphere, threshold);
        for (auto i = static_cast<std::uint32_t>(begin); i < end && !monitor.interrupted; ++i)
            if (needs.power(i))
                from.count(i, counts_.data() + i * hemisphere.cells().size());
    });
}

double PyramidMap::patches_in(std::uint32_t patch, std::size_t cell) const {
    return log_byte::value(counts_[patch * hemisphere_.cells().size() + cell]);
}

void PyramidMap::leaves(std::uint32_t patch, std::vector<DensityLeaf>& result) const {
    result.clear();
    for (std::size_t root = 0; root < Hemisphere::cells_up_to(0); ++root)
        add_leaves(patch, root, result);
}

void PyramidMap::add_leaves(std::uint32_t patch, std::size_t cell,
                            std::vector<DensityLeaf>& result) const {
    const Hemisphere::Cell& triangle = hemisphere_.cells()[cell];
    const double patches = patches_in(patch, cell);
    if (triangle.level < hemisphere_.depth() && is_divided(patches, threshold_)) {
        for (std::size_t child = 0; child < 4; ++child)
            add_leaves(patch, triangle.first_child + child, result);
        return;
    }
    const double mean_solid_angle = 2 * std::numbers::pi / std::ldexp(4, 2 * hemisphere_.depth());
    const double crowd = patches * mean_solid_angle / triangle.solid_angle;
    result.push_back({static_cast<std::uint16_t>(cell), static_cast<float>(std::sqrt(crowd))});
}

} // namespace hemilux
