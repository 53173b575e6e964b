#pragma once
// Embree over the same facets, behind a few functions.

#include "rays.h"

#include <embree3/rtcore.h>

#include <span>
#include <string>
#include <vector>

namespace hemilux::bench {

/// How Embree builds its tree.
struct EmbreeBuild {
    bool robust = false;       ///< watertight, slower
    bool high_quality = false; ///< with spatial splits; else medium
    bool quads = false;        ///< quads as quads; else each as two triangles
    RTCFilterFunctionN filter = nullptr;
};

class EmbreeScene {
  public:
    /// Builds at once, in one thread.
    EmbreeScene(const FacetSoup& soup, const EmbreeBuild& how);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene scene() const { return scene_; }
    [[nodiscard]] double build_seconds() const { return build_seconds_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; } ///< buffers of vertices left out
    /// The facet of one of Embree's primitives.
    [[nodiscard]] std::uint32_t facet(std::uint32_t primitive) const { return facet_[primitive]; }

  private:
    RTCDevice device_;
    RTCScene scene_;
    double build_seconds_ = 0;
    std::size_t bytes_ = 0;
    std::vector<float> vertices_;
    std::vector<std::uint32_t> indices_, facet_;
};

/// How Embree is asked: ray by ray, in packets of 4, 8 or 16, or as a stream of 64.
struct EmbreeQuery {
    enum class By { one, packets_of_4, packets_of_8, packets_of_16, streams } by = By::one;
    bool coherent = false; ///< the flag that promises rays to be alike
    bool occluded = false; ///< rtcOccluded in place of rtcIntersect
};
[[nodiscard]] std::string name_of(const EmbreeQuery& query);

/// Rays in all of Embree's forms, made ahead of the race: a query only copies them, as it writes
/// into them.
class EmbreeRays {
  public:
    EmbreeRays(std::span<const Ray> rays, float t_min);

    std::span<const Ray> rays;
    std::vector<RTCRayHit> ones;
    std::vector<RTCRayHit4> fours;
    std::vector<RTCRayHit8> eights;
    std::vector<RTCRayHit16> sixteens;
};

/// The primitives that were hit, in `out`; with a scene of counting_filter how many there are;
/// else, for rtcOccluded, 1 where there is one.
void embree_trace(const EmbreeScene& scene, const EmbreeQuery& query, const EmbreeRays& rays,
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
