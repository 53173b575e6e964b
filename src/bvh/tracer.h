#pragma once
// The questions that radiosity asks about rays, and the one interface behind which they are
// answered: by the BVH in programs, by brute force in tests.

#include "geometry/vector.h"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace hemilux {

/// This marks "no facet".
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The points origin + t direction, for t in (t_min, t_max]. t counts in lengths of the direction,
/// which need not be of unit length.
struct Ray {
    Vec3 origin; ///< origin in the units of the facets
    Vec3 direction;
    double t_max = std::numeric_limits<double>::infinity();
    /// It is large enough that rounding makes no ray hit a coplanar duplicate of the facet it
    /// starts on. It is small enough that no ray misses a wall near its origin. (Scenes lie in
    /// [-1,1]^3.)
    double t_min = 1e-13;
    /// The planar facet that the ray starts on; it cannot be hit again, so it is left out. This
    /// stands in place of an epsilon.
    std::uint32_t from = none;
};

/// The point where a ray hits a facet.
struct Hit {
    std::uint32_t facet;
    double t; ///< distance in lengths of the ray's direction
    /// The barycentric coordinates [-] in the triangle that was hit: point = (1-u-v) p0 + u p1 + v
    /// p2. The triangle is corners (0,1,2), or (0,2,3) in the second half of a quad.
    double u, v;
    bool second_half;
    bool front; ///< the counter-clockwise side was hit
};

/// The nearest facet, and whether its counter-clockwise side was hit. Most patches need no more of
/// a hit; Tracer::locate finds the rest.
struct FacetHit {
    std::uint32_t facet = none;
    bool front = false;
};

/// Returns this much of a hit, if there is one.
[[nodiscard]] inline FacetHit facet_hit(const std::optional<Hit>& hit) {
    return hit ? FacetHit{hit->facet, hit->front} : FacetHit{};
}

class Tracer {
  public:
    virtual ~Tracer() = default;
    /// Returns the nearest facet; of several at the same distance the one with the smallest index.
    [[nodiscard]] virtual std::optional<Hit> closest(const Ray& ray) const = 0;
    /// Returns whether anything but `target` lies on the ray before t_max.
    [[nodiscard]] virtual bool occluded(const Ray& ray, std::uint32_t target = none) const = 0;
    /// Returns how many facets the ray pierces. A ray through a shared edge or vertex pierces one
    /// of those that lie around it.
    [[nodiscard]] virtual std::uint32_t count(const Ray& ray) const = 0;

    // These functions ask the same questions about many rays at once, with the same answers: out[k]
    // is that of ray k. By default they ask one by one.

    /// Finds the nearest facets of rays that have nothing in common.
    virtual void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const;
    /// Sets out[k] != 0 where something but targets[k] lies on ray k.
    virtual void occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                                 std::span<std::uint8_t> out) const;
    /// Counts the facets that each ray pierces.
    virtual void count_stream(std::span<const Ray> rays, std::span<std::uint32_t> out) const;
    /// Returns the full hit record of a ray that is known to hit `facet` first.
    [[nodiscard]] virtual Hit locate(const Ray& ray, std::uint32_t facet) const;
    /// Returns the share of light [-] that comes along a ray which nothing occludes up to t_max. It
    /// is less than 1 where something on the way dims light without being a facet.
    [[nodiscard]] virtual double passed(const Ray&) const { return 1; }
    /// Returns the same up to t.
    [[nodiscard]] double passed_up_to(Ray ray, double t) const {
        ray.t_max = t;
        return passed(ray);
    }
    /// Returns a tracer whose rays end at facets alone. Whoever uses it has to multiply the light
    /// along a ray by passed().
    [[nodiscard]] virtual const Tracer& of_facets() const { return *this; }
};

} // namespace hemilux
