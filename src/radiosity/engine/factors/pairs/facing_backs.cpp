#include "radiosity/engine/factors/pairs/facing_backs.h"

#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>

namespace hemilux {
namespace {

/// A height over a plane that counts as in it, in the unit of a scene in [-1,1]^3.
constexpr double height_of_backs = 1e-9;

constexpr std::size_t facets_of_group = 64;

/// Returns the heights of the lowest and the highest corner of a box along a vector, over a point.
std::array<double, 2> heights(const Box& box, const Vec3& along, const Vec3& point) {
    const Vec3 half = .5 * box.extent();
    const double middle = glm::dot(along, box.centre() - point),
                 reach = glm::dot(half, glm::abs(along));
    return {middle - reach, middle + reach};
}

/// Returns whether the back of a facet faces a patch.
bool shows_its_back(const Polygon& shape, const Patch& to) {
    if (std::ranges::none_of(shape.corner, [&to](const Vec3& corner) {
            return glm::dot(to.normal, corner - to.shape.corner[0]) > height_of_backs;
        }))
        return false;
    const Vec3 front = shape.area_vector();
    const double level = -height_of_backs * glm::length(front);
    return std::ranges::any_of(to.shape.corner, [&](const Vec3& corner) {
        return glm::dot(front, corner - shape.corner[0]) < level;
    });
}

} // namespace

FacingBacks::FacingBacks(const Mesh& mesh) : mesh_(mesh) {
    Box room;
    for (const Patch& patch : mesh.patches())
        room.include(box_of(patch.shape.corner));
    const auto facets = static_cast<std::uint32_t>(mesh.scene().facets.size());
    for (std::uint32_t facet = 0; facet < facets; ++facet) {
        if (facet % facets_of_group == 0)
            groups_.emplace_back();
        if (mesh.has_back(facet))
            continue;
        const Polygon shape = mesh.shape_of(facet);
        const Vec3 front = shape.area_vector();
        const double level = -height_of_backs * glm::length(front);
        if (!(heights(room, front, shape.corner[0])[0] < level))
            continue;
        groups_.back().box.include(box_of(shape.corner));
        groups_.back().facets.push_back(facet);
    }
    std::erase_if(groups_, [](const Group& group) { return group.facets.empty(); });
}

bool FacingBacks::face(const Patch& patch, Last& last) const {
    std::size_t& begin = last[main_direction(patch.normal)];
    for (std::size_t k = 0; k < groups_.size(); ++k) {
        const std::size_t at = (begin + k) % groups_.size();
        const Group& group = groups_[at];
        if (!(heights(group.box, patch.normal, patch.shape.corner[0])[1] > height_of_backs) ||
            std::ranges::none_of(group.facets, [&](std::uint32_t facet) {
                return shows_its_back(mesh_.shape_of(facet), patch);
            }))
            continue;
        begin = at;
        return true;
    }
    return false;
}

} // namespace hemilux
