#include "radiosity/light/rooms/reached_places.h"

#include "geometry/frame.h"
#include "radiosity/engine/rays/point_emitter.h"
#include "radiosity/paper/rays/shot.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hemilux {
namespace {

bool is_bright(const Vec3& light) { return light.r > 0 || light.g > 0 || light.b > 0; }

/// What emits: facets, then lights without extent.
class Emitters {
  public:
    explicit Emitters(const Mesh& mesh) : mesh_(mesh), points_(point_emitters_of(mesh.scene())) {
        double sum = 0;
        const auto add = [&](double weight) {
            sums_.push_back(sum += std::isfinite(weight) ? std::max(weight, 0.0) : 0);
        };
        for (std::uint32_t f = 0; f < mesh.scene().facets.size(); ++f)
            add(mesh.shape_of(f).area() * glm::dot(material_of(f).emission, Vec3(1)));
        const double scale = mesh.frame().scale;
        for (const PointEmitter& point : points_)
            add(power_per_intensity(point) * scale * scale * glm::dot(point.intensity, Vec3(1)));
    }
    [[nodiscard]] bool empty() const { return !(sums_.back() > 0); }
    [[nodiscard]] const Material& material_of(std::uint32_t facet) const {
        return mesh_.scene().materials[mesh_.scene().facets[facet].material];
    }
    /// Returns whether a side of a facet emits.
    [[nodiscard]] bool shines(std::uint32_t facet, bool back) const {
        return is_bright(material_of(facet).emission) && (!back || mesh_.has_back(facet));
    }

    /// Returns whether light comes from a random emitter.
    [[nodiscard]] bool sends_light(const SeenPlace& to, const Tracer& tracer, Rng& rng) const {
        const auto drawn = std::ranges::upper_bound(sums_, rng.uniform() * sums_.back());
        const auto k = static_cast<std::size_t>(std::min(drawn, sums_.end() - 1) - sums_.begin());
        const std::size_t facets = mesh_.scene().facets.size();
        const bool has_extent = k < facets;
        const auto facet = static_cast<std::uint32_t>(k);
        const double v = rng.uniform(), u = rng.uniform();
        const Vec3 from = has_extent ? mesh_.shape_of(facet).sample({u, v})
                                     : mesh_.frame().to_local(points_[k - facets].position);
        const Vec3 way = from - to.point;
        if (!(glm::dot(way, to.normal) > 0))
            return false;
        if (has_extent) {
            const bool back = glm::dot(way, mesh_.whole_side(facet, false).normal) > 0;
            if (!shines(facet, back))
                return false;
        } else if (!(relative_intensity(points_[k - facets], -glm::normalize(way)) > 0))
            return false;
        constexpr double off = 1e-7; // layers that lie in one place do not hide each other
        return !tracer.occluded({.origin = to.point,
                                 .direction = way,
                                 .t_max = has_extent ? 1 - off : 1,
                                 .t_min = off,
                                 .from = to.facet},
                                has_extent ? facet : none);
    }

  private:
    const Mesh& mesh_;
    std::span<const PointEmitter> points_;
    std::vector<double> sums_; ///< running sums of powers
};

/// Follows a path back from a place; returns whether it finds light.
bool finds_light(const Mesh& mesh, const Tracer& tracer, const Emitters& emitters, SeenPlace place,
                 Rng& rng) {
    constexpr int reflections = 3;
    for (int k = 0;; ++k) {
        if (emitters.sends_light(place, tracer, rng))
            return true;
        const Ray ray{.origin = place.point,
                      .direction = Frame::from_normal(place.normal).to_world(sample_cosine(rng)),
                      .from = place.facet};
        const std::optional<Hit> hit = tracer.closest(ray);
        if (!hit)
            return false;
        if (emitters.shines(hit->facet, !hit->front))
            return true;
        const std::optional<SeenPlace> next = place_seen(mesh, tracer, ray);
        if (k == reflections || !next || !is_bright(emitters.material_of(next->facet).reflectance))
            return false;
        place = *next;
    }
}

} // namespace

double share_reached_by_light(const Mesh& mesh, const Tracer& tracer,
                              std::span<const SeenPlace> places) {
    constexpr int paths = 8;
    const Emitters emitters(mesh);
    if (emitters.empty() || places.empty())
        return 0;
    std::size_t reached = 0;
    Rng rng(4);
    for (const SeenPlace& place : places)
        for (int k = 0; k < paths; ++k)
            if (finds_light(mesh, tracer, emitters, place, rng)) {
                ++reached;
                break;
            }
    return double(reached) / double(places.size());
}

double share_of_lit_spaces(const Mesh& mesh, const Tracer& tracer, const FreeSpace& free) {
    constexpr double min_reached = 0.003; // less may be a ray through a crack
    double lit = 0, all = 0;
    for (const Space& space : free.spaces) {
        const auto places = double(space.places.size());
        all += places;
        lit += share_reached_by_light(mesh, tracer, space.seen) > min_reached ? places : 0;
    }
    return all > 0 ? lit / all : 0;
}

} // namespace hemilux
