#include "radiosity/answers/vertices/corner_meetings.h"

#include "radiosity/engine/cells/patch_cells.h"
#include "radiosity/engine/needs/welded_edges.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <unordered_map>

namespace hemilux {
namespace {

/// Positions nearer than this, in the local frame, are one.
constexpr double weld_distance = 1e-9;

/// Finds for each corner the first of those that are one with it. It sweeps along a direction in
/// which hardly any two other points are as near.
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

/// A point on an edge of the file that facets share, or at one of its ends.
struct EdgePoint {
    double place; ///< along the edge
    std::uint32_t point;
};

class SideSearch {
  public:
    SideSearch(const Mesh& mesh, const CornerMeetings& meetings)
        : mesh_(mesh), points_(mesh.patches().size()),
          first_patch_(mesh.scene().facets.size() + 1, 0) {
        for (std::uint32_t v = 0; v + 1 < meetings.first.size(); ++v)
            for (std::uint32_t k = meetings.first[v]; k < meetings.first[v + 1]; ++k)
                points_[meetings.corner[k].patch].at(meetings.corner[k].corner) = v;
        for (const Patch& patch : mesh.patches())
            ++first_patch_[patch.facet + 1];
        std::partial_sum(first_patch_.begin(), first_patch_.end(), first_patch_.begin());
    }

    /// The sides that cells share are cut at their middles (engine/cells/patch_cells.h), and both
    /// cells have the same bytes for them.
    void search_within_facets() {
        for (const Patch& patch : mesh_.patches())
            if (mesh_.is_divided(patch.facet)) {
                const std::size_t i = index_of(patch);
                for (std::size_t c = 0; c < size_of(patch); ++c)
                    point_at_.emplace(patch.shape.corner[c], points_[i][c]);
            }
        for (const Patch& patch : mesh_.patches())
            if (mesh_.is_divided(patch.facet))
                for (std::uint32_t c = 0; c < size_of(patch); ++c)
                    halve({static_cast<std::uint32_t>(index_of(patch)), c, 0, 0},
                          patch.shape.corner[c], patch.shape.corner[(c + 1) % size_of(patch)], 1);
    }

    /// Two facets may cut their common edge into different numbers of pieces.
    void search_between_facets() {
        const FacetSoup soup = mesh_.soup();
        const auto is_divided = [&](const Edge& edge) { return mesh_.is_divided(edge.facet); };
        const std::vector<Edge> edges = edges_of(soup.facets, first_of_point(soup.vertices));
        for_each_place(edges, [&](auto begin, auto end) {
            if (end - begin > 1 && std::any_of(begin, end, is_divided))
                search_edge(soup.vertices[begin->ends >> 32],
                            soup.vertices[static_cast<std::uint32_t>(begin->ends)], {begin, end});
        });
    }

    /// Returns each point once: both searches may have found the same.
    [[nodiscard]] std::vector<PointOnSide> take() {
        std::ranges::sort(found_);
        const auto same = [](const PointOnSide& a, const PointOnSide& b) {
            return a.patch == b.patch && a.side == b.side && a.point == b.point;
        };
        found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
        return std::move(found_);
    }

  private:
    [[nodiscard]] std::size_t index_of(const Patch& patch) const {
        return static_cast<std::size_t>(&patch - mesh_.patches().data());
    }
    [[nodiscard]] static std::size_t size_of(const Patch& patch) {
        return static_cast<std::size_t>(patch.shape.size());
    }

    /// Finds the points between a and b, which are `part` of the side from side.place on.
    void halve(PointOnSide side, const Vec3& a, const Vec3& b, double part) {
        const Vec3 between = middle(a, b);
        const auto at = point_at_.find(between);
        if (at == point_at_.end() || glm::distance(a, between) <= weld_distance)
            return;
        halve(side, a, between, part / 2);
        side.place += part / 2;
        side.point = at->second;
        found_.push_back(side);
        halve(side, between, b, part / 2);
    }

    void search_edge(const Vec3& a, const Vec3& b, std::span<const Edge> edges) {
        const Vec3 along = b - a;
        const auto place_of = [&](const Vec3& p) {
            return glm::dot(p - a, along) / glm::dot(along, along);
        };
        const auto is_on_edge = [&](const Vec3& p) {
            return glm::distance(p, a + place_of(p) * along) <= weld_distance;
        };
        std::vector<EdgePoint> on_edge;
        std::vector<PointOnSide> sides; // the point is where the side ends
        for (const Edge& edge : edges)
            for (std::uint32_t i = first_patch_[edge.facet]; i < first_patch_[edge.facet + 1];
                 ++i) {
                const Patch& patch = mesh_.patches()[i];
                for (std::uint32_t c = 0; c < size_of(patch); ++c)
                    if (const Vec3& corner = patch.shape.corner[c]; is_on_edge(corner)) {
                        on_edge.push_back({place_of(corner), points_[i][c]});
                        if (is_on_edge(patch.shape.corner[(c + 1) % size_of(patch)]))
                            sides.push_back({i, c, 0, 0});
                    }
            }
        std::ranges::sort(on_edge, {}, &EdgePoint::place);
        for (const PointOnSide& side : sides)
            add_between(side, on_edge, place_of);
    }

    template <class PlaceOf>
    void add_between(PointOnSide side, const std::vector<EdgePoint>& on_edge,
                     const PlaceOf& place_of) {
        const Patch& patch = mesh_.patches()[side.patch];
        const std::uint32_t next = (side.side + 1) % static_cast<std::uint32_t>(size_of(patch));
        const double begin = place_of(patch.shape.corner[side.side]);
        const double end = place_of(patch.shape.corner[next]);
        for (auto at =
                 std::ranges::lower_bound(on_edge, std::min(begin, end), {}, &EdgePoint::place);
             at != on_edge.end() && at->place <= std::max(begin, end); ++at) {
            if (at->point == points_[side.patch][side.side] ||
                at->point == points_[side.patch][next])
                continue;
            side.place = (at->place - begin) / (end - begin);
            side.point = at->point;
            found_.push_back(side);
        }
    }

    const Mesh& mesh_;
    std::vector<std::array<std::uint32_t, 4>> points_; ///< points of the corners of each patch
    std::vector<std::uint32_t> first_patch_;           ///< first patch of each facet
    std::unordered_map<Vec3, std::uint32_t, PositionHash> point_at_;
    std::vector<PointOnSide> found_;
};

} // namespace

CornerMeetings find_meetings(const Mesh& mesh) {
    const std::span<const Patch> patches = mesh.patches();
    std::vector<Vec3> corners;
    for (const Patch& patch : patches)
        corners.insert(corners.end(), patch.shape.corner.begin(),
                       patch.shape.corner.begin() + patch.shape.size());
    const std::vector<std::uint32_t> first = first_of_point(corners);
    CornerMeetings result;
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

std::vector<PointOnSide> find_points_on_sides(const Mesh& mesh, const CornerMeetings& meetings) {
    const auto is_divided = [&](const Patch& patch) { return mesh.is_divided(patch.facet); };
    if (std::ranges::none_of(mesh.patches(), is_divided))
        return {};
    SideSearch search(mesh, meetings);
    search.search_within_facets();
    search.search_between_facets();
    return search.take();
}

} // namespace hemilux
