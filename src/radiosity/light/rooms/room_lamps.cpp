#include "radiosity/light/rooms/room_lamps.h"

#include "geometry/box.h"
#include "geometry/elementary.h"
#include "radiosity/paper/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace hemilux {
namespace {

/// Returns up to `count` of the items, evenly.
std::vector<Vec3> some_of(const std::vector<Vec3>& all, std::size_t count) {
    if (all.size() <= count)
        return all;
    std::vector<Vec3> some;
    for (std::size_t k = 0; k < count; ++k)
        some.push_back(all[k * all.size() / count]);
    return some;
}

/// A lamp that could hang somewhere.
struct Candidate {
    RoomLamp lamp;
    std::vector<std::size_t> sees; ///< numbers of places
};

class LampSearch {
  public:
    LampSearch(const Mesh& mesh, const Tracer& tracer, const Space& space, int up)
        : mesh_(mesh), tracer_(tracer), places_(some_of(space.places, 500)),
          is_lit_(places_.size(), false) {
        up_[up] = 1;
        diagonal_ = glm::length(box_of(space.places).extent());
        for (const Vec3& from : some_of(space.places, 80))
            if (const auto lamp = lamp_above(from))
                candidates_.push_back({*lamp, seen_from(lamp->centre)});
    }

    /// Returns the best lamp for what is not lit yet, which is lit then.
    std::optional<RoomLamp> next(double volume_of_one) {
        constexpr double min_share = 0.06;
        const Candidate* best = nullptr;
        double best_score = 0;
        for (const Candidate& candidate : candidates_) {
            const double score = score_of(candidate);
            if (score > best_score) {
                best = &candidate;
                best_score = score;
            }
        }
        if (!best)
            return std::nullopt;
        const std::optional<Candidate> centred = moved_to_middle(*best);
        constexpr double as_good = 0.95;
        if (centred && score_of(*centred) > as_good * best_score)
            best = &*centred;
        std::size_t newly = 0;
        for (const std::size_t k : best->sees) {
            newly += !is_lit_[k];
            is_lit_[k] = true;
        }
        if (double(newly) < std::max(1.0, min_share * double(places_.size())))
            return std::nullopt;
        RoomLamp lamp = best->lamp;
        constexpr double area_per_volume = 7; // between a cube's 6 and that of flat rooms
        lamp.area = area_per_volume * elementary::pow(double(newly) * volume_of_one, 2.0 / 3);
        return lamp;
    }
    [[nodiscard]] std::size_t places() const { return places_.size(); }

  private:
    [[nodiscard]] double distance(const Vec3& from, const Vec3& direction) const {
        const std::optional<Hit> hit = tracer_.closest({.origin = from, .direction = direction});
        const bool is_near =
            hit && !mesh_.scene().materials[mesh_.scene().facets[hit->facet].material].is_far;
        return is_near ? hit->t : std::numeric_limits<double>::infinity();
    }

    /// Returns a lamp under the ceiling above a place, a little below it and as wide as suits the
    /// height of the room.
    [[nodiscard]] std::optional<RoomLamp> lamp_above(const Vec3& from) const {
        constexpr double below_ceiling = 0.04, wide = 0.14, of_clearance = 0.6, narrow = 0.02;
        constexpr int sides = 12;
        const double above = distance(from, up_), height = above + distance(from, -up_);
        if (!std::isfinite(height))
            return std::nullopt;
        const Vec3 centre = from + (above - below_ceiling * height) * up_;
        const Frame frame = Frame::from_normal(up_);
        double clearance = std::numeric_limits<double>::infinity();
        for (int k = 0; k < sides; ++k) {
            const Vec2 around = elementary::on_circle(2 * std::numbers::pi * k / sides);
            clearance =
                std::min(clearance, distance(centre, around.x * frame.x + around.y * frame.y));
        }
        const double radius = std::min(wide * height, of_clearance * clearance);
        if (!(radius > narrow * height) ||
            tracer_.occluded({.origin = from, .direction = centre - from, .t_max = 1}))
            return std::nullopt;
        return RoomLamp{centre, radius, 0};
    }

    [[nodiscard]] std::vector<std::size_t> seen_from(const Vec3& lamp) const {
        std::vector<std::size_t> seen;
        for (std::size_t k = 0; k < places_.size(); ++k)
            if (!tracer_.occluded({.origin = lamp, .direction = places_[k] - lamp, .t_max = 1}))
                seen.push_back(k);
        return seen;
    }

    /// Returns the lamp above the middle of what a candidate would newly light.
    [[nodiscard]] std::optional<Candidate> moved_to_middle(const Candidate& candidate) const {
        Vec3 sum(0.0);
        double count = 0;
        for (const std::size_t k : candidate.sees)
            if (!is_lit_[k]) {
                sum += places_[k];
                ++count;
            }
        const auto lamp = count > 0 ? lamp_above(sum / count) : std::nullopt;
        if (!lamp)
            return std::nullopt;
        return Candidate{*lamp, seen_from(lamp->centre)};
    }

    [[nodiscard]] double score_of(const Candidate& candidate) const {
        double score = 0;
        for (const std::size_t k : candidate.sees) {
            const double d = 4 * glm::distance(places_[k], candidate.lamp.centre) / diagonal_;
            score += is_lit_[k] ? 0 : 1 / (1 + d * d);
        }
        return score;
    }

    const Mesh& mesh_;
    const Tracer& tracer_;
    Vec3 up_{0.0};
    std::vector<Vec3> places_;
    std::vector<bool> is_lit_; ///< by place
    double diagonal_ = 1;
    std::vector<Candidate> candidates_;
};

} // namespace

std::vector<RoomLamp> lamps_of_space(const Mesh& mesh, const Tracer& tracer, const Space& space,
                                     double volume_of_place, int up, std::size_t max_lamps) {
    LampSearch search(mesh, tracer, space, up);
    const double volume_of_one =
        volume_of_place * double(space.places.size()) / double(search.places());
    std::vector<RoomLamp> lamps;
    while (lamps.size() < max_lamps) {
        const std::optional<RoomLamp> lamp = search.next(volume_of_one);
        if (!lamp)
            break;
        lamps.push_back(*lamp);
    }
    return lamps;
}

} // namespace hemilux
