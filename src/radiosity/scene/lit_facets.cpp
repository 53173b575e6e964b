#include "radiosity/scene/lit_facets.h"

#include "geometry/box.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace hemilux {
namespace {

/// Heights above a plane that are nothing but rounding [local units]. A facet that shines at
/// another from less would give it less than this share of its light.
constexpr double least_height = 1e-12;

constexpr std::size_t sides_per_leaf = 8;
/// Nodes visited per side, on average, before the rest is taken to be lit.
constexpr std::size_t most_visits = 64;

/// One side of a facet: its corners, and the plane normal . x = offset.
struct Side {
    std::array<Vec3, 4> corner;
    Vec3 normal;
    double offset;
    /// A corner is in front if it is higher than this: less than least_height, down to minus
    /// infinity, where the plane is not well known.
    double threshold;

    Side(const Polygon& shape) : corner(shape.corner), normal(shape.normal()) {
        const Vec3 centre = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
        offset = glm::dot(normal, centre);
        double longest = 0, warp = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            longest = std::max(longest, glm::length(corner[(i + 1) % 4] - corner[i]));
            warp = std::max(warp, std::abs(height(corner[i])));
        }
        // A normal is off by rounding, and by corners off the plane, times length over width; at
        // the far end of the scene, 4 units away at most, a height by so much more.
        constexpr double rounding = 1e-15;
        const double length_over_width = longest * longest / shape.area();
        const double off =
            4 * (rounding + 2 * without_rounding(warp) / longest) * length_over_width;
        threshold = least_height - off;
        if (!(off < 1))
            threshold = -std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] double height(const Vec3& point) const {
        return glm::dot(normal, point) - offset;
    }
    /// Whether some corner of the other may be in front; NaN means so.
    [[nodiscard]] bool has_in_front(const Side& other) const {
        return std::ranges::any_of(other.corner,
                                   [&](const Vec3& p) { return !(height(p) <= threshold); });
    }

  private:
    static double without_rounding(double warp) { return warp <= 1e-15 ? 0 : warp; }
};

/// What the shining sides below a node have in common: where their corners are, and bounds on their
/// planes.
struct Bounds {
    Box corners, normals;
    double least_offset = std::numeric_limits<double>::infinity();
    double least_threshold = std::numeric_limits<double>::infinity();

    void include(const Side& side) {
        for (const Vec3& p : side.corner)
            corners.include(p);
        normals.include(side.normal);
        least_offset = std::min(least_offset, side.offset);
        least_threshold = std::min(least_threshold, side.threshold);
    }
    void include(const Bounds& other) {
        corners.include(other.corners);
        normals.include(other.normals);
        least_offset = std::min(least_offset, other.least_offset);
        least_threshold = std::min(least_threshold, other.least_threshold);
    }
    /// False only if none of them shines at the side.
    [[nodiscard]] bool may_light(const Side& side) const {
        if (corners.empty())
            return false;
        if (most(side.normal, corners) - side.offset <= side.threshold)
            return false;
        return std::ranges::any_of(side.corner, [&](const Vec3& p) {
            return !(most(p, normals) - least_offset <= least_threshold);
        });
    }

  private:
    /// The largest a . x for x in the box.
    static double most(const Vec3& a, const Box& box) {
        const Vec3 m = glm::max(a * box.low, a * box.high);
        return m.x + m.y + m.z;
    }
};

class Spread {
  public:
    explicit Spread(const Mesh& mesh) : mesh_(mesh) {
        two_sided_ = std::ranges::any_of(mesh.patches(), &Patch::back);
        const FacetSoup soup = mesh.soup();
        for (const FacetCorners& corners : soup.facets) {
            Polygon shape;
            for (std::size_t i = 0; i < 4; ++i)
                shape.corner[i] = soup.vertices[corners[i]];
            sides_.emplace_back(shape);
            if (two_sided_)
                sides_.emplace_back(shape.flipped());
        }
        lit_.resize(sides_.size());
        leaves_ = std::bit_ceil((sides_.size() + sides_per_leaf - 1) / sides_per_leaf);
    }

    std::vector<bool> lit_patches() {
        std::vector<std::uint32_t> shining;
        for (std::uint32_t s = 0; s < sides_.size(); ++s)
            if (glm::any(glm::greaterThan(material(s).emission, Vec3(0.0))))
                shining.push_back(s);
        std::vector<bool> shone(sides_.size());
        while (!shining.empty()) {
            for (const std::uint32_t s : shining)
                shone[s] = true;
            gather(shining);
            shining.clear();
            for (std::uint32_t s = 0; s < sides_.size(); ++s)
                if (!lit_[s] && is_reached(s)) {
                    lit_[s] = true;
                    if (!shone[s] && glm::any(glm::greaterThan(material(s).reflectance, Vec3(0.0))))
                        shining.push_back(s);
                }
        }
        std::vector<bool> result;
        for (const Patch& patch : mesh_.patches())
            result.push_back(
                lit_[two_sided_ ? 2 * patch.facet + (patch.back ? 1 : 0) : patch.facet]);
        return result;
    }

  private:
    [[nodiscard]] const Material& material(std::uint32_t side) const {
        const Scene& scene = mesh_.scene();
        return scene.materials[scene.facets[two_sided_ ? side / 2 : side].material];
    }

    /// The tree over the sides that have just begun to shine. It is complete and in the order of
    /// the file, in which neighbours mostly follow each other.
    void gather(std::span<const std::uint32_t> shining) {
        shines_.assign(sides_.size(), false);
        nodes_.assign(2 * leaves_, Bounds{});
        for (const std::uint32_t s : shining) {
            shines_[s] = true;
            nodes_[leaves_ + s / sides_per_leaf].include(sides_[s]);
        }
        for (std::size_t i = leaves_ - 1; i > 0; --i) {
            nodes_[i] = nodes_[2 * i];
            nodes_[i].include(nodes_[2 * i + 1]);
        }
        last_ = shining.front();
    }

    /// Whether one of the tree's sides shines at this one. Looks at the last that was found first.
    bool is_reached(std::uint32_t s) {
        return sees(s, last_) || visits_ > most_visits * (sides_.size() + 1000) || search(s, 1);
    }

    bool search(std::uint32_t s, std::size_t node) {
        ++visits_;
        if (!nodes_[node].may_light(sides_[s]))
            return false;
        if (node < leaves_)
            return search(s, 2 * node) || search(s, 2 * node + 1);
        const std::size_t begin = (node - leaves_) * sides_per_leaf;
        const std::size_t end = std::min(begin + sides_per_leaf, sides_.size());
        for (std::size_t i = begin; i < end; ++i)
            if (shines_[i] && sees(s, static_cast<std::uint32_t>(i))) {
                last_ = static_cast<std::uint32_t>(i);
                return true;
            }
        return false;
    }

    [[nodiscard]] bool sees(std::uint32_t s, std::uint32_t shining) const {
        return sides_[s].has_in_front(sides_[shining]) && sides_[shining].has_in_front(sides_[s]);
    }

    const Mesh& mesh_;
    bool two_sided_ = false;
    std::vector<Side> sides_;
    std::vector<bool> lit_, shines_;
    std::vector<Bounds> nodes_; ///< [1] is the root
    std::size_t leaves_ = 1;
    std::size_t visits_ = 0;
    std::uint32_t last_ = 0;
};

} // namespace

std::vector<bool> find_lit_patches(const Mesh& mesh) { return Spread(mesh).lit_patches(); }

} // namespace hemilux
