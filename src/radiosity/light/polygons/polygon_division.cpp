#include "radiosity/light/polygons/polygon_division.h"

#include "geometry/box.h"
#include "geometry/frame.h"
#include "radiosity/light/polygons/planar_turn.h"
#include "radiosity/light/polygons/self_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {

PolygonFlags PolygonDivision::divide(std::span<const Vec3> corners) {
    pieces_.clear();
    keep_distinct(corners);
    if (kept_.size() < 3 || !scale_to_unit(corners))
        return {.degenerate = true};
    if (!project())
        return {.degenerate = true, .crossing = !is_collinear()};
    const std::size_t n = kept_.size();
    if (n == 3) {
        add_triangle(0, 1, 2);
        return {};
    }
    const Turns turn = turns();
    PolygonFlags flags{.nonplanar = !is_planar(), .concave = turn.right > 0};
    if (turn.strictly_convex() && !flags.nonplanar)
        add_strips();
    else if (n > 4 || !add_quad_cut_in_two())
        clip_ears(flags);
    return flags;
}

void PolygonDivision::keep_distinct(std::span<const Vec3> corners) {
    kept_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        if (kept_.empty() || corners[i] != corners[kept_.back()])
            kept_.push_back(i);
    while (kept_.size() > 1 && corners[kept_.front()] == corners[kept_.back()])
        kept_.pop_back();
}

/// Moves the polygon to the origin and scales it; false where it is so small that products of its
/// lengths would vanish.
bool PolygonDivision::scale_to_unit(std::span<const Vec3> corners) {
    const Vec3 first = corners[kept_.front()];
    double size = 0, largest = 0;
    point_.clear();
    for (const std::uint32_t i : kept_) {
        const Vec3 p = corners[i] - first;
        point_.push_back(p);
        for (int axis = 0; axis < 3; ++axis) {
            size = std::max(size, std::abs(p[axis]));
            largest = std::max(largest, std::abs(corners[i][axis]));
        }
    }
    constexpr double smallest = 1e-140;
    if (!(size >= smallest))
        return false;
    int exponent = 0;
    std::frexp(size, &exponent);
    for (Vec3& p : point_)
        p *= std::ldexp(1.0, -exponent);
    diagonal_ = glm::length(box_of(point_).extent());
    rounding_ = std::numeric_limits<double>::epsilon() * std::ldexp(largest, -exponent);
    return true;
}

/// Projects the polygon along its normal; false where its area is none but rounding errors.
bool PolygonDivision::project() {
    Vec3 twice_area(0.0);
    double perimeter = glm::length(point_.back());
    for (std::size_t i = 1; i < point_.size(); ++i) {
        twice_area += glm::cross(point_[i - 1], point_[i]);
        perimeter += glm::length(point_[i] - point_[i - 1]);
    }
    const double length = glm::length(twice_area);
    if (!(length > 4 * rounding_ * perimeter))
        return false;
    normal_ = twice_area / length;
    const Frame frame = Frame::from_normal(normal_);
    flat_.clear();
    for (const Vec3& p : point_)
        flat_.emplace_back(glm::dot(p, frame.x), glm::dot(p, frame.y));
    return true;
}

bool PolygonDivision::is_planar() const {
    if (point_.size() == 4)
        return is_planar_quad({0, 1, 2, 3});
    double low = 0, high = 0;
    for (const Vec3& p : point_) {
        low = std::min(low, glm::dot(p, normal_));
        high = std::max(high, glm::dot(p, normal_));
    }
    return high - low <= 2 * planarity_tolerance * diagonal_;
}

/// The distance between the diagonals is twice that of the corners from the plane between them.
bool PolygonDivision::is_planar_quad(const Piece& quad) const {
    const Vec3 d = point_[quad[2]] - point_[quad[0]], e = point_[quad[3]] - point_[quad[1]];
    const Vec3 n = glm::cross(d, e);
    const double volume = std::abs(glm::dot(n, point_[quad[1]] - point_[quad[0]]));
    const double longer = std::max(glm::length(d), glm::length(e));
    return volume <= 2 * planarity_tolerance * longer * glm::length(n);
}

bool PolygonDivision::is_collinear() const {
    const auto far =
        std::max_element(point_.begin(), point_.end(), [](const Vec3& a, const Vec3& b) {
            return glm::dot(a, a) < glm::dot(b, b);
        });
    return std::all_of(point_.begin(), point_.end(), [&](const Vec3& p) {
        return glm::length(glm::cross(p, *far)) <= 8 * rounding_;
    });
}

/// Returns whether all corners turn left and the edges go round just once.
bool PolygonDivision::Turns::strictly_convex() const {
    return right == 0 && straight == 0 && reversals == 2;
}

PolygonDivision::Turns PolygonDivision::turns() const {
    Turns result;
    const std::size_t n = flat_.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 &a = flat_[i], &b = flat_[(i + 1) % n], &c = flat_[(i + 2) % n];
        const int turn = turn_at(a, b, c, rounding_);
        result.right += turn < 0;
        result.straight += turn == 0;
        result.reversals += (b.x > a.x) != (c.x > b.x);
    }
    return result;
}

void PolygonDivision::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    pieces_.push_back({kept_[a], kept_[b], kept_[c], kept_[c]});
}

void PolygonDivision::add_strips() {
    std::uint32_t i = 0, j = static_cast<std::uint32_t>(kept_.size()) - 1;
    for (; j - i >= 3; ++i, --j) {
        const Piece quad{i, i + 1, j - 1, j};
        if (is_planar_quad(quad)) {
            pieces_.push_back({kept_[i], kept_[i + 1], kept_[j - 1], kept_[j]});
        } else {
            add_triangle(i, i + 1, j - 1);
            add_triangle(i, j - 1, j);
        }
    }
    if (j - i == 2)
        add_triangle(i, i + 1, j);
}

/// Cuts the quad along the first diagonal with both triangles on the front; false where there is
/// none.
bool PolygonDivision::add_quad_cut_in_two() {
    for (std::uint32_t i = 0; i < 2; ++i) {
        const std::uint32_t a = i, b = i + 1, c = i + 2, d = (i + 3) % 4;
        if (turn_at(flat_[a], flat_[b], flat_[c], rounding_) <= 0 ||
            turn_at(flat_[a], flat_[c], flat_[d], rounding_) <= 0)
            continue;
        add_triangle(a, b, c);
        add_triangle(a, c, d);
        return true;
    }
    return false;
}

void PolygonDivision::clip_ears(PolygonFlags& flags) {
    work.divide += DivisionWork::divide_each * flat_.size();
    work.compare += DivisionWork::compare_each * flat_.size();
    for (const EarClipper::Triangle& t : clipper_.clip(flat_, rounding_, work.divide))
        add_triangle(t[0], t[1], t[2]);
    flags.unfinished = work.divide == 0;
    flags.crossing = clipper_.ran_out_of_ears();
    if (flags.crossing)
        return;
    const std::optional<bool> crosses = crosses_itself(flat_, rounding_, work.compare);
    flags.crossing = crosses.value_or(false);
    flags.unchecked = !crosses;
}

} // namespace hemilux
