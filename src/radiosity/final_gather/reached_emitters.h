#pragma once
// The emitters that points reach by shadow rays, and these rays: each goes to an emitter that is
// drawn by its light (emitter_choice.h), and brings it by its exact factor (point_to_patch.h).

#include "bvh/tracer.h"
#include "geometry/polygon_sampler.h"
#include "radiosity/emitters/emitter_choice.h"
#include "radiosity/final_gather/surface_points.h"
#include "radiosity/sampling/sobol.h"
#include "radiosity/scene/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hemilux {

class Rng;

/// Shadow rays that are not traced yet.
struct ShadowRays {
    struct Sample {
        std::uint32_t place; ///< of the estimate
        Vec3 light;          ///< if nothing is in the way [W/m2]
    };
    std::vector<Ray> rays;
    std::vector<Sample> samples;        ///< of each ray
    std::vector<std::uint32_t> targets; ///< the facet of each ray's emitter
    std::vector<std::uint8_t> blocked;  ///< of those that were traced last

    /// Traces them and forgets them; calls add(place, light) for what arrives. Returns how many
    /// there were.
    template <class Add>
    std::size_t trace(const Tracer& tracer, const Add& add) {
        blocked.resize(rays.size());
        tracer.occluded_stream(rays, targets, blocked);
        for (std::size_t k = 0; k < rays.size(); ++k)
            if (!blocked[k])
                add(samples[k].place, samples[k].light);
        const std::size_t traced = rays.size();
        clear();
        return traced;
    }
    void add(const Ray& ray, std::uint32_t target, const Sample& sample) {
        rays.push_back(ray);
        targets.push_back(target);
        samples.push_back(sample);
    }
    void clear() {
        rays.clear();
        samples.clear();
        targets.clear();
    }
};

/// The chances of emitters, for a point or for those of a patch. Dark before they are weighed.
struct WeighedEmitters {
    EmitterChoice::Cut cut;
    std::uint32_t patch = none; ///< none: of a point

    /// Whether shadow rays are better than to leave emitters to rays at random.
    [[nodiscard]] bool pays() const { return !cut.dark() && cut.pays(); }
};

class ReachedEmitters {
  public:
    /// The small emitters of a mesh (small_emitters.h), which outlives this.
    explicit ReachedEmitters(const Mesh& mesh);

    /// What a patch emits that shadow rays find [W/m2].
    [[nodiscard]] const Vec3& emission(std::uint32_t patch) const { return emission_[patch]; }
    /// Prepares shadow rays of a point. It has the chances of its patch, where it names that.
    void weigh(const SurfacePoint& point, WeighedEmitters& weighed) const;
    /// Adds rays for `count` points of the sequence, `first` and those after it; some see nothing
    /// of their emitter and are left out. The light of each is its share of their mean.
    void add_rays(const SurfacePoint& point, const WeighedEmitters& weighed,
                  SobolBlocks<5>& numbers, std::uint32_t first, std::uint32_t count,
                  std::uint32_t place, ShadowRays& rays) const;
    /// Adds one ray, of which `share` of the light counts.
    void add_ray(const SurfacePoint& point, const WeighedEmitters& weighed, Rng& rng,
                 const Vec3& share, std::uint32_t place, ShadowRays& rays) const;

  private:
    ReachedEmitters(const Mesh& mesh, const std::vector<std::uint32_t>& emitters);

    struct Emitter {
        Patch side; ///< of a whole facet
        PolygonSampler points;
        double near; ///< from the centre, see look_at
        Vec3 emission;
    };
    /// Makes a ray to a point of the emitter. Returns how much of the emission it brings there
    /// [-], over the chance of the emitter; 0 where the point does not face it.
    [[nodiscard]] double aim(const EmitterChoice::Choice& chosen, const SurfacePoint& point, Vec2 u,
                             Ray& ray) const;

    std::vector<Vec3> emission_; ///< by patch
    std::vector<Patch> sides_;
    std::vector<Emitter> emitters_;
    EmitterChoice choice_;
};

} // namespace hemilux
