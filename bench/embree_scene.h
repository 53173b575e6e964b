#pragma once
// Embree over the same triangles, behind a few functions. Quads are given as two triangles.

#include "rays.h"

#include <embree3/rtcore.h>

#include <span>

namespace hemilux::bench {

class EmbreeScene {
  public:
    /// Builds at once, in one thread, at medium quality. `filter` lets rays be counted, or leave
    /// out the facet they start on.
    EmbreeScene(const FacetSoup& soup, bool robust, RTCFilterFunctionN filter = nullptr);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene scene() const { return scene_; }
    [[nodiscard]] double build_seconds() const { return build_seconds_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; } ///< buffers of vertices left out
    /// The facet of one of Embree's triangles.
    [[nodiscard]] std::uint32_t facet(std::uint32_t triangle) const { return facet_[triangle]; }

  private:
    RTCDevice device_;
    RTCScene scene_;
    double build_seconds_ = 0;
    std::size_t bytes_ = 0;
    std::vector<float> vertices_;
    std::vector<std::uint32_t> indices_, facet_;
};

[[nodiscard]] RTCRayHit embree_ray(const Ray& ray, float t_min);

/// The facets struck, one ray at a time.
void embree_closest(const EmbreeScene& scene, std::span<const Ray> rays,
                    std::span<std::uint32_t> out);
/// All facets on each ray, by a filter that refuses them: with intersect1, occluded1 or
/// intersect16.
enum class CountBy { intersect1, occluded1, intersect16 };
void embree_count(const EmbreeScene& counting, CountBy by, std::span<const Ray> rays,
                  std::span<std::uint32_t> out);
/// Refuses everything and counts what does not belong to the facet that the ray starts on.
void counting_filter(const RTCFilterFunctionNArguments* arguments);
/// Refuses the facet that the ray starts on.
void starting_facet_filter(const RTCFilterFunctionNArguments* arguments);

/// The nearest facet and its distance by the robust scene with starting_facet_filter.
struct EmbreeHit {
    std::uint32_t facet;
    float t;
};
[[nodiscard]] EmbreeHit embree_robust_hit(const EmbreeScene& scene, const Ray& ray);

} // namespace hemilux::bench
