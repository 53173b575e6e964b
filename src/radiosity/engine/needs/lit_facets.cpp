#include "radiosity/engine/needs/lit_facets.h"

#include "radiosity/engine/needs/covered_sides.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace hemilux {
namespace {

/// Heights above a plane that are nothing but rounding [local units]. A facet that shines at
/// another from less would give it less than this share of its light.
constexpr double min_height = 1e-12;

/// The number of pairs tested in vain before the rest is taken to be lit. They take a quarter of a
/// second at most.
constexpr std::size_t max_looks = 10'000'000;

/// One side of a facet: its corners, and the plane normal . x = offset.
struct Side {
    std::array<Vec3, 4> corner;
    Vec3 normal;
    double offset;
    /// A corner is in front if its height exceeds this threshold. It is below min_height, down to
    /// minus infinity where the plane is not well known.
    double threshold;

    Side(const Polygon& shape) : corner(shape.corner), normal(shape.normal()) {
        const Vec3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
        offset = glm::dot(normal, centre);
        double longest = 0, warp = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            longest = std::max(longest, glm::length(corner[(i + 1) % 4] - corner[i]));
            warp = std::max(warp, std::abs(height(corner[i])));
        }
        // Rounding and corners off the plane tilt a normal by their size times length over width.
        // At the far end of the scene, 4 units away at most, heights are off by 4 times that.
        constexpr double rounding = 1e-15;
        const double length_over_width = longest * longest / shape.area();
        const double off =
            4 * (rounding + 2 * without_rounding(warp) / longest) * length_over_width;
        threshold = min_height - off;
        if (!(off < 1))
            threshold = -std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] double height(const Vec3& point) const {
        return glm::dot(normal, point) - offset;
    }
    /// Returns whether some corner of the other side may be in front; NaN counts as in front.
    [[nodiscard]] bool has_in_front(const Side& other) const {
        return std::ranges::any_of(other.corner, [&](const Vec3& p) { return is_in_front(p); });
    }
    [[nodiscard]] bool is_in_front(const Vec3& point) const {
        return !(height(point) <= threshold);
    }

  private:
    static double without_rounding(double warp) { return warp <= 1e-15 ? 0 : warp; }
};

class Spread {
  public:
    explicit Spread(const Mesh& mesh) : mesh_(mesh) {
        two_sided_ = std::ranges::any_of(mesh.patches(), &Patch::back);
        const FacetSoup soup = mesh.soup();
        for (const FacetCorners& corners : soup.facets) {
            const Polygon shape = polygon_of(soup.vertices, corners);
            sides_.emplace_back(shape);
            if (two_sided_)
                sides_.emplace_back(shape.flipped());
        }
        lit_.resize(sides_.size());
        for (std::uint32_t s = 0; s < sides_.size(); ++s)
            has_patches_.push_back(is_front(s) || mesh.has_back(facet_of(s)));
        covered_.resize(sides_.size());
        sides_faced_.resize(sides_.size());
        for (const CoveredSide& covered : find_covered_sides(mesh)) {
            if (!two_sided_ && covered.side % 2 == 1)
                continue;
            const std::uint32_t s = two_sided_ ? covered.side : covered.side / 2;
            covered_[s] = true;
            for (const FacetSide side : covered.faces)
                if (two_sided_ || side % 2 == 0)
                    sides_faced_[s].push_back(two_sided_ ? side : side / 2);
        }
    }

    std::vector<bool> lit_patches() {
        for (std::uint32_t s = 0; s < sides_.size(); ++s)
            if (has_patches_[s] && glm::any(glm::greaterThan(material(s).emission, Vec3(0.0))))
                shining_.push_back(s);
        light_by_points();
        std::vector<bool> shone(sides_.size());
        while (!shining_.empty()) {
            for (const std::uint32_t s : shining_)
                shone[s] = true;
            last_ = shining_.front();
            std::vector<std::uint32_t> next;
            for (std::uint32_t s = 0; s < sides_.size(); ++s)
                if (!lit_[s] && has_patches_[s] && is_reached(s)) {
                    lit_[s] = true;
                    if (!shone[s] && glm::any(glm::greaterThan(material(s).reflectance, Vec3(0.0))))
                        next.push_back(s);
                }
            shining_ = std::move(next);
        }
        std::vector<bool> result;
        for (const Patch& patch : mesh_.patches())
            result.push_back(
                lit_[two_sided_ ? 2 * patch.facet + (patch.back ? 1 : 0) : patch.facet]);
        return result;
    }

  private:
    [[nodiscard]] std::uint32_t facet_of(std::uint32_t side) const {
        return two_sided_ ? side / 2 : side;
    }
    [[nodiscard]] bool is_front(std::uint32_t side) const { return !two_sided_ || side % 2 == 0; }
    [[nodiscard]] const Material& material(std::uint32_t side) const {
        const Scene& scene = mesh_.scene();
        return scene.materials[scene.facets[facet_of(side)].material];
    }

    /// Lights the sides in front of which a light without extent stands. Those that reflect begin
    /// to shine.
    void light_by_points() {
        const auto emitters = point_emitters_of(mesh_.scene());
        for (const PointEmitter& emitter : emitters)
            for (std::uint32_t s = 0; s < sides_.size(); ++s) {
                if (lit_[s] || !has_patches_[s] || covered_[s] ||
                    !sides_[s].is_in_front(mesh_.frame().to_local(emitter.position)))
                    continue;
                lit_[s] = true;
                if (material(s).emission == Vec3(0.0) && material(s).reflectance != Vec3(0.0))
                    shining_.push_back(s);
            }
    }

    /// Returns whether one of the sides that have just begun to shine shines at this one. Tests the
    /// side that was found last first.
    bool is_reached(std::uint32_t s) {
        if (looks_ > max_looks || sees(s, last_))
            return true;
        const auto found =
            std::ranges::find_if(shining_, [&](std::uint32_t other) { return sees(s, other); });
        looks_ += static_cast<std::size_t>(found - shining_.begin());
        if (found == shining_.end())
            return false;
        last_ = *found;
        return true;
    }

    /// Returns whether no cover is between two sides, as far as the first one's is concerned.
    [[nodiscard]] bool may_face(std::uint32_t s, std::uint32_t other) const {
        return !covered_[s] || std::ranges::find(sides_faced_[s], other) != sides_faced_[s].end();
    }

    [[nodiscard]] bool sees(std::uint32_t s, std::uint32_t shining) const {
        return may_face(s, shining) && may_face(shining, s) &&
               sides_[s].has_in_front(sides_[shining]) && sides_[shining].has_in_front(sides_[s]);
    }

    const Mesh& mesh_;
    bool two_sided_ = false;
    std::vector<Side> sides_;
    std::vector<bool> has_patches_;
    std::vector<bool> covered_;
    std::vector<std::vector<std::uint32_t>> sides_faced_; ///< of covered sides
    std::vector<bool> lit_;
    std::vector<std::uint32_t> shining_; ///< sides that began to shine since the last round
    std::size_t looks_ = 0;
    std::uint32_t last_ = 0;
};

} // namespace

std::vector<bool> find_lit_patches(const Mesh& mesh) { return Spread(mesh).lit_patches(); }

} // namespace hemilux
