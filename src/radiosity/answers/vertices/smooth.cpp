#include "radiosity/answers/vertices/smooth.h"

#include "bvh/tracer.h"
#include "geometry/elementary.h"
#include "geometry/numeric.h"
#include "radiosity/answers/vertices/convex_triangles.h"
#include "radiosity/answers/vertices/corner_meetings.h"
#include "radiosity/light/cached_light/patch_light.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <numbers>
#include <unordered_map>

namespace hemilux {
namespace {

/// Surfaces that meet at a larger angle [degrees] are shaded apart. A column of twelve sides is
/// still smooth.
constexpr double crease_angle = 31;
const double crease_cosine = elementary::cos(crease_angle * std::numbers::pi / 180);

/// Classes among the corners of one point. Nearly equal normals share one delegate, so that the
/// apex of a fan of many facets does not take quadratic time.
class Classifier {
  public:
    void clear() { delegates_.clear(); }

    /// Returns the delegate of a patch. Two with the same `root` are in one class.
    std::uint32_t add(const Patch& patch) {
        for (std::uint32_t d = 0; d < delegates_.size(); ++d)
            if (cosine(delegates_[d], patch) > same_)
                return d;
        const auto d = static_cast<std::uint32_t>(delegates_.size());
        delegates_.push_back({patch.normal, patch.material, d});
        for (std::uint32_t other = 0; other < d; ++other)
            if (cosine(delegates_[other], patch) > crease_cosine)
                delegates_[root(other)].parent = root(d);
        return d;
    }
    std::uint32_t root(std::uint32_t d) const {
        while (delegates_[d].parent != d)
            d = delegates_[d].parent;
        return d;
    }
    std::size_t size() const { return delegates_.size(); }

  private:
    struct Delegate {
        Vec3 normal;
        std::uint32_t material;
        std::uint32_t parent;
    };
    static double cosine(const Delegate& delegate, const Patch& patch) {
        return delegate.material == patch.material ? glm::dot(delegate.normal, patch.normal) : -1;
    }

    double same_ = elementary::cos(0.5 * std::numbers::pi / 180);
    std::vector<Delegate> delegates_;
};

/// Puts the points on the sides of patches into outlines.
class OutlineBuilder {
  public:
    OutlineBuilder(const Mesh& mesh, const CornerMeetings& meetings, CornerClasses& classes)
        : patches_(mesh.patches()), meetings_(meetings), classes_(classes) {}

    /// Adds the outline of one patch; `points` are all those on its sides.
    void add(std::span<const PointOnSide> points) {
        const std::uint32_t patch = points.front().patch;
        const auto size = static_cast<std::uint32_t>(patches_[patch].shape.size());
        Outline outline{patch, {}, {}};
        for (std::uint32_t side = 0; side < size; ++side) {
            const auto end = std::ranges::find_if(
                points, [&](const PointOnSide& point) { return point.side != side; });
            const auto count = static_cast<std::size_t>(end - points.begin());
            add_side(outline.classes, points.first(count), classes_.of_patch[patch][side],
                     classes_.of_patch[patch][(side + 1) % size]);
            points = points.subspan(count);
        }
        std::vector<Vec3> corners;
        for (const std::uint32_t k : outline.classes)
            corners.push_back(classes_.position[k]);
        outline.triangles = convex_triangles(corners);
        classes_.outlines.push_back(std::move(outline));
    }

  private:
    /// Appends the classes from the corner `from` to the one before the corner `to`.
    void add_side(std::vector<std::uint32_t>& outline, std::span<const PointOnSide> points,
                  std::uint32_t from, std::uint32_t to) {
        std::vector<std::uint32_t> classes;
        for (const PointOnSide& point : points)
            classes.push_back(class_at(point));
        outline.push_back(from);
        double place = 0; // of the last class of the outline
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (classes[k] == none) {
                std::size_t next = k;
                while (next < classes.size() && classes[next] == none)
                    ++next;
                const bool is_end = next == classes.size();
                const double end = is_end ? 1 : points[next].place;
                classes[k] = add_class(points[k], {outline.back(), is_end ? to : classes[next],
                                                   (points[k].place - place) / (end - place)});
            }
            outline.push_back(classes[k]);
            place = points[k].place;
        }
    }

    /// Returns the class at a point of the corner whose surface is most like the patch's; none
    /// where there is a crease to all.
    [[nodiscard]] std::uint32_t class_at(const PointOnSide& point) const {
        double most = crease_cosine;
        std::uint32_t best = none;
        const auto offer = [&](std::uint32_t patch, std::uint32_t of_class) {
            const Patch &one = patches_[point.patch], &other = patches_[patch];
            const double cosine = glm::dot(one.normal, other.normal);
            if (one.material == other.material && cosine > most) {
                most = cosine;
                best = of_class;
            }
        };
        for (std::uint32_t k = meetings_.first[point.point]; k < meetings_.first[point.point + 1];
             ++k)
            offer(meetings_.corner[k].patch,
                  classes_.of_patch[meetings_.corner[k].patch][meetings_.corner[k].corner]);
        if (const auto own = added_.find(point.point); best == none && own != added_.end())
            for (const auto& [patch, of_class] : own->second)
                offer(patch, of_class);
        return best;
    }

    std::uint32_t add_class(const PointOnSide& point, const BetweenClasses& between) {
        const auto id = static_cast<std::uint32_t>(classes_.position.size());
        classes_.position.push_back(meetings_.position[point.point]);
        classes_.between.push_back(between);
        added_[point.point].emplace_back(point.patch, id);
        return id;
    }

    std::span<const Patch> patches_;
    const CornerMeetings& meetings_;
    CornerClasses& classes_;
    /// Patches and their classes at points where they have no corner and no surface like theirs.
    std::unordered_map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> added_;
};

/// Returns the interior angle at a corner [rad].
double corner_angle(const Polygon& shape, std::size_t c) {
    const auto n = static_cast<std::size_t>(shape.size());
    const Vec3 a = shape.corner[(c + 1) % n] - shape.corner[c];
    const Vec3 b = shape.corner[(c + n - 1) % n] - shape.corner[c];
    return elementary::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::array<double, 4> triangle_weights(const Polygon& shape, const Vec3& point) {
    const Vec3 normal = shape.area_vector();
    const auto& p = shape.corner;
    const double u = glm::dot(glm::cross(p[2] - p[1], point - p[1]), normal);
    const double v = glm::dot(glm::cross(p[0] - p[2], point - p[2]), normal);
    const double w = glm::dot(glm::cross(p[1] - p[0], point - p[0]), normal);
    const double a = std::max(u, 0.0), b = std::max(v, 0.0), c = std::max(w, 0.0);
    const double sum = a + b + c;
    if (!(sum > 0)) // no area: any weights do
        return {1, 0, 0, 0};
    return {a / sum, b / sum, c / sum, 0};
}

/// Solves point = p0 + u e + v f + u v g for u and v. Eliminating u leaves a quadratic in v whose
/// derivative at the root is the map's Jacobian, positive within a convex quad.
std::array<double, 4> quad_weights(const Polygon& shape, const Vec3& point) {
    const auto& p = shape.corner;
    const Vec3 normal = shape.area_vector();
    const auto cross = [&](const Vec3& a, const Vec3& b) {
        return glm::dot(glm::cross(a, b), normal);
    };
    const Vec3 e = p[1] - p[0], f = p[3] - p[0], g = p[0] - p[1] + p[2] - p[3], h = point - p[0];
    const double k2 = cross(g, f), k1 = cross(e, f) + cross(h, g), k0 = cross(h, e);
    const double jacobian = safe_sqrt(difference_of_products(k1, k1, 4 * k0, k2));
    double v = k1 >= 0 ? -2 * k0 / (k1 + jacobian) : (jacobian - k1) / (2 * k2);
    v = v >= 0 ? std::min(v, 1.0) : 0.0; // NaN without area
    const Vec3 across = e + v * g;
    double u = glm::dot(h - v * f, across) / glm::dot(across, across);
    u = u >= 0 ? std::min(u, 1.0) : 0.0;
    return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

} // namespace

CornerClasses find_corner_classes(const Mesh& mesh) {
    const std::span<const Patch> patches = mesh.patches();
    const CornerMeetings meetings = find_meetings(mesh);
    CornerClasses result;
    result.of_patch.resize(patches.size());
    Classifier classifier;
    std::vector<std::uint32_t> delegate, class_of_root; // of this point's corners, of delegates
    for (std::size_t v = 0; v < meetings.position.size(); ++v) {
        classifier.clear();
        delegate.clear();
        for (std::uint32_t k = meetings.first[v]; k < meetings.first[v + 1]; ++k)
            delegate.push_back(classifier.add(patches[meetings.corner[k].patch]));
        class_of_root.assign(classifier.size(), none);
        for (std::size_t k = 0; k < delegate.size(); ++k) {
            std::uint32_t& id = class_of_root[classifier.root(delegate[k])];
            if (id == none) {
                id = static_cast<std::uint32_t>(result.position.size());
                result.position.push_back(meetings.position[v]);
            }
            const PatchCorner corner = meetings.corner[meetings.first[v] + k];
            result.of_patch[corner.patch][corner.corner] = id;
        }
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (patches[i].shape.is_triangle())
            result.of_patch[i][3] = result.of_patch[i][2];
    const std::vector<PointOnSide> points = find_points_on_sides(mesh, meetings);
    OutlineBuilder builder(mesh, meetings, result);
    for (auto begin = points.begin(); begin != points.end();) {
        const auto end = std::find_if(begin, points.end(), [&](const PointOnSide& point) {
            return point.patch != begin->patch;
        });
        builder.add({begin, end});
        begin = end;
    }
    return result;
}

const Outline* outline_of(const CornerClasses& classes, std::uint32_t patch) {
    const auto at = std::ranges::lower_bound(classes.outlines, patch, {}, &Outline::patch);
    return at != classes.outlines.end() && at->patch == patch ? &*at : nullptr;
}

std::vector<Vec3> smooth(const Mesh& mesh, const CornerClasses& classes,
                         const std::function<Vec3(std::uint32_t patch, const Vec3& corner)>& value,
                         MeanOver over) {
    const std::size_t of_corners = classes.position.size() - classes.between.size();
    std::vector<Vec3> sum(of_corners, Vec3(0.0));
    std::vector<double> weight(of_corners, 0.0);
    const auto add = [&](std::uint32_t k, double angle, const Vec3& of_patch) {
        sum[k] += angle * of_patch;
        weight[k] += angle;
    };
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Polygon& shape = mesh.patches()[i].shape;
        for (std::size_t c = 0; c < static_cast<std::size_t>(shape.size()); ++c) {
            constexpr double tiny = 1e-6; // a corner of a sliver has a value too
            add(classes.of_patch[i][c], corner_angle(shape, c) + tiny, value(i, shape.corner[c]));
        }
    }
    if (over == MeanOver::outlines)
        for (const Outline& outline : classes.outlines)
            for (const std::uint32_t k : outline.classes)
                if (k < of_corners && !std::ranges::count(classes.of_patch[outline.patch], k))
                    add(k, std::numbers::pi, value(outline.patch, classes.position[k]));
    for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] /= weight[k];
    for (const auto& [from, to, place] : classes.between)
        sum.push_back((1 - place) * sum[from] + place * sum[to]);
    return sum;
}

std::vector<Vec3> smooth(const Mesh& mesh, const CornerClasses& classes,
                         std::span<const Vec3> radiosity, std::span<const Slope> slope,
                         MeanOver over) {
    const PatchLight light(radiosity, slope);
    const auto value = [&](std::uint32_t patch, const Vec3& corner) {
        return radiosity_at(mesh, light, patch, corner);
    };
    return smooth(mesh, classes, value, over);
}

std::array<double, 4> corner_weights(const Polygon& shape, const Vec3& point) {
    return shape.is_triangle() ? triangle_weights(shape, point) : quad_weights(shape, point);
}

} // namespace hemilux
