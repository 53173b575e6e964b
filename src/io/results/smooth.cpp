#include "io/results/smooth.h"

#include "bvh/tracer.h"
#include "geometry/numeric.h"
#include "radiosity/final_gather/linear_light.h"
#include "radiosity/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hemilux {
namespace {

/// Positions nearer than this, in the local frame, are one.
constexpr double weld_distance = 1e-9;

struct Corner {
    std::uint32_t patch;
    std::uint32_t corner;
};

/// The corners that meet in each point: those of point v are corner[first[v]] to
/// corner[first[v + 1]].
struct Meetings {
    std::vector<std::uint32_t> first;
    std::vector<Corner> corner;
    std::vector<Vec3> position;
};

/// The first of those that are one with each, by a sweep along a direction in which hardly any two
/// other points are as near.
std::vector<std::uint32_t> first_of_point(std::span<const Vec3> corners) {
    constexpr Vec3 along(0.4896791743, -0.5781243907, 0.6526183259);
    std::vector<double> place;
    for (const Vec3& corner : corners)
        place.push_back(glm::dot(along, corner));
    std::vector<std::uint32_t> order(corners.size()), first(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(place[i], i); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t i = first[order[k]] = order[k];
        for (std::size_t m = k; m-- > 0 && place[i] - place[order[m]] <= weld_distance;)
            if (glm::distance(corners[i], corners[order[m]]) <= weld_distance) {
                first[i] = first[order[m]];
                break;
            }
    }
    return first;
}

Meetings find_meetings(std::span<const Patch> patches) {
    std::vector<Vec3> corners;
    for (const Patch& patch : patches)
        corners.insert(corners.end(), patch.shape.corner.begin(),
                       patch.shape.corner.begin() + patch.shape.size());
    const std::vector<std::uint32_t> first = first_of_point(corners);
    Meetings result;
    std::vector<std::uint32_t> number(corners.size(), none), point;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        std::uint32_t& of_point = number[first[k]];
        if (of_point == none) {
            of_point = static_cast<std::uint32_t>(result.position.size());
            result.position.push_back(corners[k]);
        }
        point.push_back(of_point);
    }
    result.first.assign(result.position.size() + 1, 0);
    for (const std::uint32_t v : point)
        ++result.first[v + 1];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
    result.corner.resize(point.size());
    std::size_t k = 0;
    for (std::uint32_t i = 0; i < patches.size(); ++i)
        for (int c = 0; c < patches[i].shape.size(); ++c)
            result.corner[next[point[k++]]++] = {i, static_cast<std::uint32_t>(c)};
    return result;
}

/// Classes among the corners of one point. Nearly equal normals share one delegate, so that the
/// apex of a fan of many facets does not take quadratic time.
class Classifier {
  public:
    void clear() { delegates_.clear(); }

    /// The delegate of a patch. Two with the same `root` are in one class.
    std::uint32_t add(const Patch& patch) {
        for (std::uint32_t d = 0; d < delegates_.size(); ++d)
            if (cosine(delegates_[d], patch) > same_)
                return d;
        const auto d = static_cast<std::uint32_t>(delegates_.size());
        delegates_.push_back({patch.normal, patch.material, d});
        for (std::uint32_t other = 0; other < d; ++other)
            if (cosine(delegates_[other], patch) > crease_)
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

    double same_ = std::cos(0.5 * std::numbers::pi / 180);
    double crease_ = std::cos(crease_angle * std::numbers::pi / 180);
    std::vector<Delegate> delegates_;
};

/// The interior angle at a corner [rad].
double corner_angle(const Polygon& shape, std::size_t c) {
    const auto n = static_cast<std::size_t>(shape.size());
    const Vec3 a = shape.corner[(c + 1) % n] - shape.corner[c];
    const Vec3 b = shape.corner[(c + n - 1) % n] - shape.corner[c];
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
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
    const Meetings meetings = find_meetings(patches);
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
            const Corner corner = meetings.corner[meetings.first[v] + k];
            result.of_patch[corner.patch][corner.corner] = id;
        }
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
        if (patches[i].shape.is_triangle())
            result.of_patch[i][3] = result.of_patch[i][2];
    return result;
}

std::vector<Vec3>
smooth(const Mesh& mesh, const CornerClasses& classes,
       const std::function<Vec3(std::uint32_t patch, const Vec3& corner)>& value) {
    std::vector<Vec3> sum(classes.position.size(), Vec3(0.0));
    std::vector<double> weight(classes.position.size(), 0.0);
    for (std::uint32_t i = 0; i < mesh.patches().size(); ++i) {
        const Polygon& shape = mesh.patches()[i].shape;
        for (std::size_t c = 0; c < static_cast<std::size_t>(shape.size()); ++c) {
            constexpr double tiny = 1e-6; // a corner of a sliver has a value too
            const double angle = corner_angle(shape, c) + tiny;
            sum[classes.of_patch[i][c]] += angle * value(i, shape.corner[c]);
            weight[classes.of_patch[i][c]] += angle;
        }
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] /= weight[k];
    return sum;
}

std::vector<Vec3> smooth(const Mesh& mesh, const CornerClasses& classes,
                         std::span<const Vec3> radiosity, std::span<const Slope> slope) {
    const PatchLight light(radiosity, slope);
    return smooth(mesh, classes, [&](std::uint32_t patch, const Vec3& corner) {
        return radiosity_at(mesh, light, patch, corner);
    });
}

std::array<double, 4> corner_weights(const Polygon& shape, const Vec3& point) {
    return shape.is_triangle() ? triangle_weights(shape, point) : quad_weights(shape, point);
}

} // namespace hemilux
