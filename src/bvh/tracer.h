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

/// Marks "no facet".
inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// origin + t direction, for t in (t_min, t_max], in lengths of the direction, which need not be of
/// unit length.
struct Ray {
    Vec3 origin;
    Vec3 direction;
    double t_max = std::numeric_limits<double>::infinity();
    /// It is large enough that rounding makes no ray hit a coplanar duplicate of the facet it
    /// starts on, and small enough that no ray misses a wall near its origin. (Scenes lie in
    /// [-1,1]^3.)
    double t_min = 1e-13;
    /// The planar facet that the ray starts on; it cannot be hit again, so it is left out. This
    /// stands in place of an epsilon.
    std::uint32_t from = none;
};

/// Where a ray hits a facet.
struct Hit {
    std::uint32_t facet;
    double t;
    /// Barycentric coordinates in the triangle that was hit: point = (1-u-v) p0 + u p1 + v p2, the
    /// triangle being corners (0,1,2), or (0,2,3) in the second half of a quad.
    double u, v;
    bool second_half;
    bool front; ///< the counter-clockwise side was hit
};

/// The nearest facet, and whether its counter-clockwise side was hit: as much of a hit as most
/// patches need. Tracer::locate finds the rest.
struct FacetHit {
    std::uint32_t facet = none;
    bool front = false;
};

/// As much of a hit, if there is one.
[[nodiscard]] inline FacetHit facet_hit(const std::optional<Hit>& hit) {
    return hit ? FacetHit{hit->facet, hit->front} : FacetHit{};
}

class Tracer {
  public:
    virtual ~Tracer() = default;
    /// The nearest facet; of several at the same distance the one with the smallest index.
    [[nodiscard]] virtual std::optional<Hit> closest(const Ray& ray) const = 0;
    /// Whether anything but `target` lies on the ray before t_max.
    [[nodiscard]] virtual bool occluded(const Ray& ray, std::uint32_t target = none) const = 0;
    /// How many facets the ray pierces; one through a shared edge or vertex pierces one of those
    /// that lie around it.
    [[nodiscard]] virtual std::uint32_t count(const Ray& ray) const = 0;

    // The same questions about many rays at once, with the same answers: out[k] is that of ray k.
    // By default they are asked one by one.

    /// The nearest facets of rays that have nothing in common.
    virtual void closest_stream(std::span<const Ray> rays, std::span<FacetHit> out) const;
    /// out[k] != 0: something but targets[k] lies on ray k.
    virtual void occluded_stream(std::span<const Ray> rays, std::span<const std::uint32_t> targets,
                                 std::span<std::uint8_t> out) const;
    /// The full hit record of a ray that is known to hit `facet` first.
    [[nodiscard]] virtual Hit locate(const Ray& ray, std::uint32_t facet) const;
};

} // namespace hemilux
