#include "radiosity/engine/needs/closed_surfaces.h"

#include "geometry/elementary.h"
#include "geometry/polygon.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/engine/sparse/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace hemilux {
namespace {

using EdgeIterator = std::vector<Edge>::const_iterator;

class Pairs {
  public:
    explicit Pairs(const FacetSoup& soup)
        : soup_(soup), sets_(soup.facets.size()), at_border_(soup.facets.size()) {
        for_each_place(edges_of(soup.facets, first_in_place(soup.vertices)),
                       [&](auto first, auto last) {
                           if (!pair_up(first, last))
                               for (auto edge = first; edge != last; ++edge)
                                   at_border_[edge->facet] = true;
                       });
    }

    ConnectedSurfaces surfaces() {
        std::vector<Surface> all = facets_of_sets(soup_, sets_);
        for (Surface& surface : all)
            surface.closed = std::ranges::none_of(
                surface.facets, [&](std::uint32_t f) { return bool(at_border_[f]); });
        return {std::move(all), std::move(neighbours_)};
    }

  private:
    /// Joins the facets of an edge in pairs. Returns false if that is not possible.
    bool pair_up(EdgeIterator first, EdgeIterator last) {
        constexpr std::ptrdiff_t max_facets = 16;
        const auto forward =
            std::count_if(first, last, [](const Edge& edge) { return edge.forward; });
        if (2 * forward != last - first || last - first > max_facets)
            return false;
        std::vector<std::uint32_t> partners;
        for (auto edge = first; edge != last; ++edge)
            if (edge->forward)
                partners.push_back(nearest_in_front(*edge, first, last)->facet);
        std::vector<std::uint32_t> sorted = partners;
        std::ranges::sort(sorted);
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
            return false;
        auto partner = partners.begin();
        for (auto edge = first; edge != last; ++edge)
            if (edge->forward)
                join(edge->facet, *partner++);
        return true;
    }

    void join(std::uint32_t a, std::uint32_t b) {
        sets_.join(a, b);
        neighbours_.push_back({a, b});
    }

    /// Returns, of the edges that run against this one, that of the first facet that one meets when
    /// one turns from this facet to its front.
    EdgeIterator nearest_in_front(const Edge& edge, EdgeIterator first, EdgeIterator last) const {
        constexpr double flat = 1e-6;
        EdgeIterator nearest = first;
        double least = 3 * std::numbers::pi;
        const Vec3 n = normal(edge.facet), into = glm::normalize(into_facet(edge));
        for (auto other = first; other != last; ++other) {
            if (other->forward == edge.forward)
                continue;
            const Vec3 to = into_facet(*other);
            double angle = elementary::atan2(glm::dot(to, n), glm::dot(to, into));
            if (angle < flat) // behind this one, or both in one place and back to back
                angle += 2 * std::numbers::pi;
            if (angle < least) {
                least = angle;
                nearest = other;
            }
        }
        return nearest;
    }

    [[nodiscard]] Vec3 normal(std::uint32_t facet) const {
        return polygon_of(soup_.vertices, soup_.facets[facet]).normal();
    }
    /// Returns the direction from the edge into its facet.
    [[nodiscard]] Vec3 into_facet(const Edge& edge) const {
        const Vec3 a = soup_.vertices[static_cast<std::uint32_t>(edge.ends >> 32)];
        const Vec3 b = soup_.vertices[static_cast<std::uint32_t>(edge.ends)];
        return glm::cross(normal(edge.facet), edge.forward ? b - a : a - b);
    }

    const FacetSoup& soup_;
    DisjointSets sets_;
    std::vector<bool> at_border_;
    std::vector<std::array<std::uint32_t, 2>> neighbours_;
};

/// Returns the solid angle of a triangle [sr], negative where its back is seen (Van Oosterom and
/// Strackee 1983).
double signed_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double along =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return -2 * elementary::atan2(glm::dot(a, glm::cross(b - a, c - a)), along);
}

} // namespace

std::vector<Surface> facets_of_sets(const FacetSoup& soup, DisjointSets& sets) {
    std::vector<Surface> all;
    std::vector<std::uint32_t> number(soup.facets.size()); // of a set, by its least facet
    for (std::uint32_t f = 0; f < soup.facets.size(); ++f) {
        const std::uint32_t first = sets.find(f);
        if (first == f) {
            number[f] = static_cast<std::uint32_t>(all.size());
            all.emplace_back();
        }
        Surface& surface = all[number[first]];
        surface.facets.push_back(f);
        for (const std::uint32_t v : soup.facets[f])
            surface.box.include(soup.vertices[v]);
    }
    return all;
}

ConnectedSurfaces find_surfaces(const FacetSoup& soup) { return Pairs(soup).surfaces(); }

std::optional<double> winding_number(const FacetSoup& soup, const Surface& surface,
                                     const Vec3& point, std::optional<std::uint32_t> without) {
    constexpr double rounding = 1e-3;
    double sum = 0;
    for (const std::uint32_t f : surface.facets) {
        if (f == without)
            continue;
        std::array<Vec3, 4> to;
        for (std::size_t k = 0; k < 4; ++k)
            to[k] = soup.vertices[soup.facets[f][k]] - point;
        sum += signed_solid_angle(to[0], to[1], to[2]);
        if (soup.facets[f][2] != soup.facets[f][3])
            sum += signed_solid_angle(to[0], to[2], to[3]);
    }
    const double turns = sum / (4 * std::numbers::pi), half = without ? .5 : 0;
    const double nearest = std::round(turns - half) + half;
    if (!(std::abs(turns - nearest) < rounding))
        return std::nullopt;
    return nearest;
}

} // namespace hemilux
