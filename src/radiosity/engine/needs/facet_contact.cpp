#include "radiosity/engine/needs/facet_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hemilux {
namespace {

/// Depths and distances below this count as none [local units].
constexpr double thin = 1e-9;

/// Returns the gap between the polygons along an axis; negative: how far they overlap there. An
/// axis without length separates nothing.
double gap_along(const Vec3& direction, const Polygon& a, const Polygon& b) {
    const double length = glm::length(direction);
    if (!(length > 0))
        return -std::numeric_limits<double>::infinity();
    const auto range = [&](const Polygon& p) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& corner : p.corner) {
            const double at = glm::dot(direction, corner) / length;
            low = std::min(low, at);
            high = std::max(high, at);
        }
        return std::array{low, high};
    };
    const auto [a_low, a_high] = range(a);
    const auto [b_low, b_high] = range(b);
    return std::max(b_low - a_high, a_low - b_high);
}

Vec3 edge_of(const Polygon& p, std::size_t k) { return p.corner[(k + 1) % 4] - p.corner[k]; }

/// Returns whether all corners lie in the other's plane.
bool lies_in_plane_of(const Polygon& a, const Polygon& b) {
    const Vec3 n = b.normal();
    return std::ranges::all_of(
        a.corner, [&](const Vec3& p) { return std::abs(glm::dot(n, p - b.corner[0])) <= thin; });
}

/// Finds the largest gap along some axes, but looks no further beyond the first above `enough`.
class LargestGap {
  public:
    LargestGap(const Polygon& a, const Polygon& b, double enough) : a_(a), b_(b), enough_(enough) {}

    void in_plane() {
        for (const Polygon* p : {&a_, &b_})
            for (std::size_t k = 0; k < 4; ++k)
                along(glm::cross(p->area_vector(), edge_of(*p, k)));
    }
    void in_space() {
        along(a_.area_vector());
        along(b_.area_vector());
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k)
                along(glm::cross(edge_of(a_, j), edge_of(b_, k)));
    }
    [[nodiscard]] double gap() const { return gap_; }

  private:
    void along(const Vec3& direction) {
        if (!(gap_ > enough_))
            gap_ = std::max(gap_, gap_along(direction, a_, b_));
    }
    const Polygon &a_, &b_;
    double enough_, gap_ = -std::numeric_limits<double>::infinity();
};

/// Moves corners towards the centre by a part of the way.
template <class Which>
Polygon shrunk(Polygon p, double part, const Which& which) {
    const Vec3 centre = p.centre();
    for (Vec3& corner : p.corner)
        if (which(corner))
            corner += part * (centre - corner);
    return p;
}

bool is_corner_of(const Vec3& p, const Polygon& of) {
    return std::ranges::any_of(of.corner,
                               [&](const Vec3& c) { return glm::length(c - p) <= thin; });
}

/// Returns whether the polygons share opposite corners of a quad.
bool share_diagonal_of(const Polygon& quad, const Polygon& other) {
    const auto shares = [&](std::size_t k) { return is_corner_of(quad.corner[k], other); };
    return !quad.is_triangle() && ((shares(0) && shares(2)) || (shares(1) && shares(3)));
}

} // namespace

bool lies_within(const Polygon& a, const Polygon& b) {
    const Vec3 n = b.normal();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 inward = glm::cross(n, edge_of(b, k));
        const double length = glm::length(inward);
        if (std::ranges::any_of(a.corner, [&](const Vec3& p) {
                return glm::dot(inward, p - b.corner[k]) < -thin * length;
            }))
            return false;
    }
    return true;
}

Contact contact_of(const Polygon& a, const Polygon& b) {
    const bool in_one_plane = lies_in_plane_of(a, b) || lies_in_plane_of(b, a);
    LargestGap largest(a, b, thin);
    if (in_one_plane)
        largest.in_plane();
    else
        largest.in_space();
    if (largest.gap() > thin)
        return Contact::apart;
    if (largest.gap() >= -thin)
        return Contact::touching;
    return in_one_plane ? Contact::overlay : Contact::crossing;
}

bool touches_inside(const Polygon& a, const Polygon& b) {
    constexpr double edge = 1e-6, apart = 1e-12;
    const Polygon inner = shrunk(a, edge, [](const Vec3&) { return true; });
    LargestGap largest(inner, b, apart);
    largest.in_space();
    largest.in_plane();
    return !(largest.gap() > apart);
}

bool meet_beside_shared_edge(const Polygon& a, const Polygon& b) {
    constexpr double away = 1e-3;
    const auto shared = [&](const Vec3& corner) { return is_corner_of(corner, b); };
    return contact_of(shrunk(a, away, shared), b) != Contact::apart || share_diagonal_of(a, b) ||
           share_diagonal_of(b, a);
}

} // namespace hemilux
