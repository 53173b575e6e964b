#include "radiosity/engine/needs/sealed_spaces.h"

#include "bvh/intersect.h"
#include "geometry/box.h"
#include "geometry/polygon.h"
#include "radiosity/engine/needs/closed_surfaces.h"
#include "radiosity/engine/needs/facet_contact.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/engine/sparse/disjoint_sets.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace hemilux {
namespace {

// Beyond these numbers of pairs of boxes, of solid angles and of spaces nothing is found. Each
// takes a quarter of a second at most.
constexpr std::size_t max_boxes = 50'000'000, max_solid_angles = 4'000'000, max_spaces = 1000;

/// The winding number of a surface at a place.
struct Winding {
    static constexpr int unknown = std::numeric_limits<int>::max();
    std::uint32_t surface;
    int number;
    auto operator<=>(const Winding&) const = default;
};

/// The winding numbers at a place that are not 0, in the order of the surfaces.
using Windings = std::vector<Winding>;

bool may_be_one_space(const Windings& a, const Windings& b) {
    const auto agree = [](int x, int y) {
        return x == y || x == Winding::unknown || y == Winding::unknown;
    };
    auto p = a.begin(), q = b.begin();
    while (p != a.end() || q != b.end()) {
        const bool in_a = q == b.end() || (p != a.end() && p->surface <= q->surface);
        const bool in_b = p == a.end() || (q != b.end() && q->surface <= p->surface);
        if (!agree(in_a ? p->number : 0, in_b ? q->number : 0))
            return false;
        p += in_a ? 1 : 0;
        q += in_b ? 1 : 0;
    }
    return true;
}

bool contains(const Box& box, const Vec3& point) {
    return glm::all(glm::lessThanEqual(box.low, point)) &&
           glm::all(glm::lessThanEqual(point, box.high));
}

/// Returns the number of the surface that each facet belongs to.
std::vector<std::uint32_t> numbers_by_facet(std::span<const Surface> surfaces, std::size_t facets) {
    std::vector<std::uint32_t> number(facets);
    for (std::uint32_t s = 0; s < surfaces.size(); ++s)
        for (const std::uint32_t f : surfaces[s].facets)
            number[f] = s;
    return number;
}

/// The windings of all places that matter: sides with patches, and lights without extent.
class Places {
  public:
    /// Takes the facets where the scene has them: offset from others in their plane
    /// (layered_mesh.h) they would have no common edges with their neighbours.
    explicit Places(const Mesh& mesh)
        : mesh_(mesh), corners_(corners_of(mesh.scene())), soup_{mesh.vertices(), corners_},
          touches_(corners_.size()) {
        ConnectedSurfaces found = find_surfaces(soup_);
        surfaces_ = std::move(found.all);
        neighbours_ = std::move(found.neighbours);
        for (const FacetCorners& corners : corners_)
            shapes_.push_back(polygon_of(mesh.vertices(), corners));
        surface_of_ = numbers_by_facet(surfaces_, corners_.size());
    }

    /// Returns false if there is one space only, as far as can be found in time.
    bool find() {
        const bool one_sided = std::ranges::none_of(mesh_.patches(), &Patch::back);
        const bool no_points = point_emitters_of(mesh_.scene()).empty();
        if (one_sided && no_points && surfaces_.size() == 1)
            return false;
        drop_empty_solids();
        if (std::ranges::none_of(surfaces_, &Surface::closed) || !find_contacts() ||
            !find_windings())
            return false;
        list_places();
        keep_surfaces_that_tell();
        return true;
    }

    [[nodiscard]] const Windings& of_side(std::uint32_t facet, bool front) const {
        return of_side_[2 * std::size_t{facet} + (front ? 0 : 1)];
    }
    [[nodiscard]] const Windings& of_point(std::size_t emitter) const { return of_point_[emitter]; }
    [[nodiscard]] std::size_t points() const { return of_point_.size(); }

  private:
    /// How a facet lies on a closed surface.
    enum class Lies { alike, opposite, in_front, behind, unknown };

    static std::vector<FacetCorners> corners_of(const Scene& scene) {
        std::vector<FacetCorners> corners;
        for (const Facet& facet : scene.facets)
            corners.push_back(facet.vertex);
        return corners;
    }

    /// Takes closed surfaces for open that no patch and no light can be inside of. They keep
    /// nothing apart, and most things in a room are such.
    void drop_empty_solids() {
        std::vector<std::uint32_t> order(surfaces_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, {},
                          [&](std::uint32_t s) { return std::pair(surfaces_[s].box.low.x, s); });
        std::vector<bool> may_hold(surfaces_.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                const std::uint32_t a = order[i], b = order[j];
                if (surfaces_[b].box.low.x > surfaces_[a].box.high.x)
                    break;
                if (!meet(surfaces_[a].box, surfaces_[b].box))
                    continue;
                may_hold[a] = may_hold[a] || holds_facet(surfaces_[a], surfaces_[b]);
                may_hold[b] = may_hold[b] || holds_facet(surfaces_[b], surfaces_[a]);
            }
        for (std::uint32_t s = 0; s < surfaces_.size(); ++s)
            surfaces_[s].closed = surfaces_[s].closed &&
                                  (may_hold[s] || holds_point(surfaces_[s]) || looks_inside(s));
    }

    [[nodiscard]] bool holds_facet(const Surface& surface, const Surface& other) const {
        return surface.closed && std::ranges::any_of(other.facets, [&](std::uint32_t f) {
                   const auto inside = [&](const Vec3& p) { return contains(surface.box, p); };
                   return std::ranges::all_of(shapes_[f].corner, inside);
               });
    }
    [[nodiscard]] bool holds_point(const Surface& surface) const {
        return std::ranges::any_of(
            point_emitters_of(mesh_.scene()), [&](const PointEmitter& emitter) {
                return contains(surface.box, mesh_.frame().to_local(emitter.position));
            });
    }
    /// Returns whether a surface has patches on its inner side.
    [[nodiscard]] bool looks_inside(std::uint32_t s) const {
        double volume = 0; // of cones over the facets
        bool has_back = false;
        for (const std::uint32_t f : surfaces_[s].facets) {
            volume +=
                glm::dot(shapes_[f].centre() - surfaces_[s].box.low, shapes_[f].area_vector());
            has_back = has_back || mesh_.has_back(f);
        }
        return has_back || !(volume > 0);
    }

    /// Finds which facets pass through a closed surface, lie on it or touch it. A surface that
    /// passes through itself or touches itself counts as open.
    bool find_contacts() {
        std::vector<bool> of_closed(corners_.size());
        for (std::uint32_t f = 0; f < corners_.size(); ++f)
            of_closed[f] = surfaces_[surface_of_[f]].closed;
        return for_each_close_pair(shapes_, of_closed, [&](std::uint32_t f, std::uint32_t g) {
            const std::uint32_t a = surface_of_[f], b = surface_of_[g];
            if (!surfaces_[a].closed && !surfaces_[b].closed)
                return;
            if (a == b)
                surfaces_[a].closed = !meet_beside_shared_edge(shapes_[f], shapes_[g]);
            else
                note_contact(f, g);
        });
    }

    void note_contact(std::uint32_t f, std::uint32_t g) {
        const Contact contact = contact_of(shapes_[f], shapes_[g]);
        if (contact == Contact::crossing)
            crossing_.insert({{surface_of_[f], surface_of_[g]}, {surface_of_[g], surface_of_[f]}});
        if (contact != Contact::overlay && contact != Contact::touching)
            return;
        for (const auto& [one, other] : {std::pair(f, g), std::pair(g, f)}) {
            if (!surfaces_[surface_of_[other]].closed)
                continue;
            touches_[one] = true;
            if (contact == Contact::overlay)
                note_overlay(one, other);
            else if (touches_inside(shapes_[one], shapes_[other]))
                overlay_[{one, surface_of_[other]}] = Lies::unknown;
        }
    }

    /// Notes that facet f lies on facet g. What lies on one facet, and no more of it elsewhere, is
    /// in the space on the side to which it is offset, or each of its sides is in the space that it
    /// faces.
    void note_overlay(std::uint32_t f, std::uint32_t g) {
        const Polygon &shape = shapes_[f], &on = shapes_[g];
        const Vec3 n = on.normal();
        const double height =
            glm::dot(n, mesh_.shape_of(f).corner[0] - mesh_.shape_of(g).corner[0]);
        Lies lies = glm::dot(shape.normal(), n) > 0 ? Lies::alike : Lies::opposite;
        if (!lies_within(shape, on))
            lies = Lies::unknown;
        else if (std::abs(height) > between_layers)
            lies = height > 0 ? Lies::in_front : Lies::behind;
        const auto [at, is_new] = overlay_.try_emplace({f, surface_of_[g]}, lies);
        if (!is_new && at->second != lies)
            at->second = Lies::unknown;
    }

    /// Puts facets together that neighbours connect without touching a closed surface: all of them
    /// lie in the same space.
    void find_pieces() {
        DisjointSets sets(corners_.size());
        for (const auto& [f, g] : neighbours_)
            if (!touches_[f] && !touches_[g])
                sets.join(f, g);
        pieces_ = facets_of_sets(soup_, sets);
        piece_of_ = numbers_by_facet(pieces_, corners_.size());
    }

    /// Finds the windings of the closed surfaces at each piece of others, and in front of
    /// themselves.
    bool find_windings() {
        find_pieces();
        around_.resize(pieces_.size());
        front_.assign(surfaces_.size(), Winding::unknown);
        std::size_t looks = 0;
        for (std::uint32_t s = 0; s < surfaces_.size(); ++s) {
            if (!surfaces_[s].closed)
                continue;
            if ((looks += pieces_.size()) > max_boxes)
                return false;
            front_[s] = winding_in_front(s);
            for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
                const std::uint32_t of = surface_of_[pieces_[p].facets[0]];
                if (of == s || !meet(surfaces_[s].box, pieces_[p].box))
                    continue;
                const int number =
                    crossing_.contains({of, s}) ? Winding::unknown : winding_at(s, pieces_[p]);
                if (number != 0)
                    around_[p].push_back({s, number});
            }
        }
        return solid_angles_ <= max_solid_angles;
    }

    int winding_at(std::uint32_t s, const Surface& piece) {
        for (const std::uint32_t f : piece.facets)
            if (const auto number = winding_at_centre(s, f))
                return static_cast<int>(std::lround(*number));
        return Winding::unknown;
    }
    int winding_in_front(std::uint32_t s) {
        for (const std::uint32_t f : surfaces_[s].facets)
            if (const auto number = winding_at_centre(s, f))
                return static_cast<int>(std::lround(*number + .5));
        return Winding::unknown;
    }
    std::optional<double> winding_at_centre(std::uint32_t s, std::uint32_t f) {
        if (overlay_.contains({f, s}) ||
            (solid_angles_ += surfaces_[s].facets.size()) > max_solid_angles)
            return std::nullopt;
        return winding_number(soup_, surfaces_[s], shapes_[f].centre(),
                              surface_of_[f] == s ? std::optional(f) : std::nullopt);
    }

    void list_places() {
        of_side_.resize(2 * corners_.size());
        for (std::uint32_t f = 0; f < corners_.size(); ++f) {
            of_side_[2 * std::size_t{f}] = windings_at_side(f, true);
            if (mesh_.has_back(f))
                of_side_[2 * std::size_t{f} + 1] = windings_at_side(f, false);
        }
        for (const PointEmitter& emitter : point_emitters_of(mesh_.scene()))
            of_point_.push_back(windings_at(mesh_.frame().to_local(emitter.position)));
    }

    Windings windings_at_side(std::uint32_t f, bool front) const {
        const std::uint32_t s = surface_of_[f];
        Windings windings = around_[piece_of_[f]];
        const auto set = [&](std::uint32_t surface, bool in_front) {
            std::erase_if(windings, [&](const Winding& w) { return w.surface == surface; });
            const int number = front_[surface] == Winding::unknown || in_front
                                   ? front_[surface]
                                   : front_[surface] - 1;
            if (number != 0)
                windings.push_back({surface, number});
        };
        if (surfaces_[s].closed)
            set(s, front);
        for (auto at = overlay_.lower_bound({f, 0}); at != overlay_.end() && at->first.first == f;
             ++at) {
            const std::uint32_t surface = at->first.second;
            if (!surfaces_[surface].closed)
                continue;
            const Lies lies = at->second;
            set(surface, lies == Lies::in_front || lies == (front ? Lies::alike : Lies::opposite));
            if (lies == Lies::unknown) {
                std::erase_if(windings, [&](const Winding& w) { return w.surface == surface; });
                windings.push_back({surface, Winding::unknown});
            }
        }
        std::ranges::sort(windings);
        return windings;
    }

    Windings windings_at(const Vec3& point) const {
        Windings windings;
        for (std::uint32_t s = 0; s < surfaces_.size(); ++s)
            if (surfaces_[s].closed && contains(surfaces_[s].box, point)) {
                const auto number = winding_number(soup_, surfaces_[s], point);
                if (number != 0.0)
                    windings.push_back(
                        {s, number ? static_cast<int>(std::lround(*number)) : Winding::unknown});
            }
        return windings;
    }

    /// Forgets the surfaces around which all places that are known lie alike: most things in a room
    /// are closed and contain nothing.
    void keep_surfaces_that_tell() {
        std::vector<bool> tells(surfaces_.size());
        const auto for_all = [&](const auto& visit) {
            for (std::vector<Windings>* places : {&of_side_, &of_point_})
                for (Windings& windings : *places)
                    visit(windings);
        };
        for_all([&](const Windings& windings) {
            for (const Winding& w : windings)
                if (w.number != Winding::unknown)
                    tells[w.surface] = true;
        });
        for_all([&](Windings& windings) {
            std::erase_if(windings, [&](const Winding& w) { return !tells[w.surface]; });
        });
    }

    const Mesh& mesh_;
    std::vector<FacetCorners> corners_;
    std::vector<Polygon> shapes_;
    FacetSoup soup_;
    std::vector<Surface> surfaces_;
    std::vector<std::uint32_t> surface_of_;
    std::vector<std::array<std::uint32_t, 2>> neighbours_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> crossing_;      ///< surfaces
    std::map<std::pair<std::uint32_t, std::uint32_t>, Lies> overlay_; ///< facet, surface
    std::vector<bool> touches_; ///< facets that touch a closed surface
    std::vector<Surface> pieces_;
    std::vector<std::uint32_t> piece_of_;
    std::vector<Windings> around_; ///< of other surfaces, at each piece
    std::vector<int> front_;       ///< a closed surface's own number in front of it
    std::size_t solid_angles_ = 0;
    std::vector<Windings> of_side_, of_point_;
};

} // namespace

SealedSpaces::SealedSpaces(const Mesh& mesh) {
    Places places(mesh);
    if (!places.find())
        return;
    std::map<Windings, std::uint32_t> number;
    const auto number_of = [&](const Windings& windings) {
        return number.try_emplace(windings, static_cast<std::uint32_t>(number.size()))
            .first->second;
    };
    for (std::uint32_t facet = 0; facet < mesh.scene().facets.size(); ++facet)
        for (const bool front : {true, false})
            of_side_.push_back(
                front || mesh.has_back(facet) ? number_of(places.of_side(facet, front)) : 0);
    for (std::size_t point = 0; point < places.points(); ++point)
        of_point_.push_back(number_of(places.of_point(point)));
    if (number.size() == 1 || number.size() > max_spaces) {
        of_side_.clear();
        of_point_.clear();
        return;
    }
    count_ = static_cast<std::uint32_t>(number.size());
    exchange_.resize(std::size_t{count_} * count_);
    for (const auto& [a, i] : number)
        for (const auto& [b, j] : number)
            exchange_[std::size_t{i} * count_ + j] = may_be_one_space(a, b);
}

} // namespace hemilux
